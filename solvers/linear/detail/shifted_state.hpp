/// @file
/// Common parts of the solvers of second-order eigenvalue problems: scaling, shift, checks.
#pragma once

#include "solvers/linear/linearise.hpp"

namespace cardan::solvers {

/// Rigid-body modes are those below this times lowest_scale().
inline constexpr double rigid_ratio_of_modes = 1e-4;
/// Modes above this times lowest_scale() may be rounding.
inline constexpr double doubtful_ratio_of_modes = 1e6;
/// The shift of shift-invert methods, in units of lowest_scale(): below the lowest frequency, and not an eigenvalue.
inline constexpr double mode_shift = 0.1;

/// A frequency near the lowest elastic one, rad/s: the smallest Rayleigh quotient of a single coordinate. Where there
/// is no spring at all, a small stiffness is what rounding leaves of loads that cancel.
double lowest_scale(const SecondOrderSystem& system);

/// @param scratch  overwritten
/// @param states  number of them
/// @throws InputError for matrices that are not n x n, or have other states, NumericalError if one is not finite or the
/// mass matrix is not positive definite
void check_modes_input(const SecondOrderSystem& system, Eigen::Index n, Eigen::Index states, Matrix& scratch);

}  // namespace cardan::solvers
