/// @file
/// The two-bladed teetered machine of Lee, Hodges and Patil (2002) as its tests have it.
#pragma once

#include "turbines/machines/teetered.hpp"

namespace cardan::testing {

inline constexpr double teetered_speed = 6.02;  ///< nominal, rad/s

/// Torsion has the armature that makes it O(h^4).
/// @param ratio  of the tower's rigidity to the blade's
inline turbines::TeeteredTurbine teetered_machine(int elements, bool rigid_tower = false, double ratio = 100) {
    turbines::TeeteredOptions options = turbines::TeeteredOptions::with_elements(elements);
    options.rigid_tower = rigid_tower;
    options.tower.torsion_armature = options.blade.torsion_armature = -1. / 12;
    return turbines::assemble(turbines::with_tower_rigidity(turbines::teetered_description(), ratio), options);
}

}  // namespace cardan::testing
