/// @file
/// Left vectors of modes, with local states eliminated. Internal to solvers: not installed.
#pragma once

#include "solvers/linear/linearise.hpp"

namespace cardan::solvers {

/// Coordinates and states, y and w, of
///
///     y^H (lambda^2 M + lambda C + K) = w^H (f_q + lambda f_qd),  w^H (lambda - f_s) = y^H Q_s,
///
/// by inverse iteration next to the eigenvalue, in real arithmetic. In each step the states follow from the
/// coordinates, group by group of those that couple (GroupedMatrix): for n coordinates and m local states the cost
/// is that of some n^3 + n^2 m, in memory n (n + m), rather than of (n + m)^3 and (n + m)^2.
/// @param eigenvalue  next to which the iteration is made: 1e-9 of it beside
/// @param units       > 0: in those of coordinates their rows and columns are alike in size, those of states are the
/// states'
/// @return y, w, not normalised
ComplexVector left_vector(const SecondOrderSystem& system, Complex eigenvalue, const Vector& units);

}  // namespace cardan::solvers
