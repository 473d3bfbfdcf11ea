/// @file
/// A model, the forces on it and its loops: what solvers work on.
#pragma once

#include "mbs/loops/loops.hpp"
#include "mbs/system/forces.hpp"

namespace cardan {

struct System {
    System(const Tree& tree, const ForceSet& set, const LoopSet& closed = {})
        : model(tree), forces(set, model), loops(closed, model) {}

    /// @throws InputError naming a loop: for analyses that know trees only
    void require_no_loops(const char* where) const {
        if (!loops.empty()) refuse_loops(where);
    }

    Model model;
    Forces forces;
    Loops loops;

private:
    [[noreturn]] void refuse_loops(const char* where) const;
};

}  // namespace cardan
