/// @file
/// Oscillations of states of first order among the modes. Internal to solvers/stability: not installed.
#pragma once

#include "solvers/campbell/point.hpp"

namespace cardan::solvers {

/// Oscillating motions of states become modes, with unit energy as these have.
void take_vibrations_of_states(const PointSolver& solver, CampbellPoint& point);

}  // namespace cardan::solvers
