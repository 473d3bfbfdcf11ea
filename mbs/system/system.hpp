/// @file
/// A model and the forces on it: what solvers work on.
#pragma once

#include "mbs/system/forces.hpp"

namespace cardan {

struct System {
    System(const Tree& tree, const ForceSet& set) : model(tree), forces(set, model) {}

    Model model;
    Forces forces;
};

}  // namespace cardan
