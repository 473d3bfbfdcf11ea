/// @file
/// Mann's tensor over the cells between wave numbers of a box.
#pragma once

#include "elements/turbulence/detail/shear_table.hpp"

namespace cardan::detail {

/// Mean of the tensor over the cell [k_2 - dk_2/2, k_2 + dk_2/2] x [k_3 - dk_3/2, k_3 + dk_3/2], over
/// alpha epsilon^(2/3) L^(17/3)/(4 pi). Large eddies need it: at k_1 -> 0 the tensor has peaks of width k_1 there.
/// Allocates nothing.
/// @param shear  for the wave numbers of the cell
/// @param k      centre; k_1 > 0, k_2 and k_3 zero or half a cell from it at least
Mat3 mean_over_cell(const ShearTable& shear, double length_scale, const Vec3& k, double dk2, double dk3);

/// A with A A^T = Phi, lower triangular but for the order of its rows, of a positive semidefinite tensor.
Mat3 triangular_root(const Mat3& Phi);

}  // namespace cardan::detail
