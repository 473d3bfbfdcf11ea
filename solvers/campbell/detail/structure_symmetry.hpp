/// @file
/// Whether the blades and the hub of a rotor are alike. Internal to solvers/campbell: not installed.
#pragma once

#include "solvers/campbell/point.hpp"
#include "solvers/periodic/periodic_system.hpp"

namespace cardan::solvers {

/// Do mass or springs of the machine, undeformed and in multi-blade rows, change when its rotor turns from one blade to
/// the next? If not, and equations differ all the same, it is what acts on the blades that does.
/// @param rows   has the rows
/// @param limit  of the difference, over the roots of the diagonals
bool structure_differs(const System& system, const RotorMap& rotor, const PointSolver& rows,
                       const BladeSymmetry& symmetry, double limit);

/// Whether blades and their states do at every azimuth what the next ones did a part of a turn before, up to 1e-7 of
/// the largest.
bool blades_move_alike(const RotorMap& rotor, const PeriodicSteadyState& state, const StateTable& states);

}  // namespace cardan::solvers
