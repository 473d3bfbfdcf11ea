/// @file
/// A text summary of an assembly.
#pragma once

#include "mbs/model/model.hpp"

#include <string>

namespace cardan {

/// Mass and centre of mass at q = 0 of everything welded under one part name, in base axes.
struct PartMass {
    std::string part;
    double mass;                                         ///< kg
    Vec3 centre;                                         ///< m
    Vec3 first_moment() const { return mass * centre; }  ///< about the base origin, kg m
    bool reduced;                                        ///< some inertia of the part is modelled about some axes only
};
std::vector<PartMass> masses_by_part(const Tree& tree);

/// Bodies, coordinates (name, unit, role), masses by part, total mass and centre of mass, armatures, reduced inertias.
std::string summary(const Tree& tree);

}  // namespace cardan
