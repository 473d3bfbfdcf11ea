/// @file
/// Rotations of two columns or two rows of complex matrices, in whole registers.
#pragma once

#include "mbs/base/types.hpp"

#include <Eigen/Jacobi>

namespace cardan::solvers {

/// Columns x, y := [x y] G of n numbers each, G = [c conj(s); -s conj(c)]. (Eigen's applyOnTheRight)
void rotate_columns(std::ptrdiff_t n, const Eigen::JacobiRotation<Complex>& G, Complex* x, Complex* y);
/// Two consecutive rows := G^* times them; rows[0], rows[1] are those of the first column, and the next column stands
/// `stride` numbers further. (Eigen's applyOnTheLeft of the adjoint)
void rotate_rows(std::ptrdiff_t columns, const Eigen::JacobiRotation<Complex>& G, Complex* rows, std::ptrdiff_t stride);

}  // namespace cardan::solvers
