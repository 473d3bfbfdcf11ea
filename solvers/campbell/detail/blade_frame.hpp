/// @file
/// Motions of single blades seen from the blades, which turn.
#pragma once

#include "solvers/campbell/diagram.hpp"

namespace cardan::solvers {

/// A mode at standstill, in multi-blade rows, as it is if the blades carry their part of it along when the rotor begins
/// to turn: T(psi)^T T(0) z, a sum of harmonics.
/// @param rotor_speed  of the turning rotor, rad/s
CampbellMode carried_along(const CampbellMode& at_rest, const ColemanTransform& T, double rotor_speed);

/// Gives the Floquet modes of branches that are named after one blade their frequency in the rotating frame, of which
/// the fixed frame has several (CampbellMode::own_harmonic becomes the principal one).
void take_blade_frequencies(Campbell& diagram);

}  // namespace cardan::solvers
