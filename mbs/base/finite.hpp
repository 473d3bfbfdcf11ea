/// @file
/// Whether all numbers of a matrix are finite.
#pragma once

#include "mbs/base/types.hpp"

#include <cmath>

namespace cardan {

/// Whether all numbers are finite, by their sum: faster than A.allFinite(), which goes number by number. The sum is not
/// finite if one of the numbers is not. (It may also be too large where all are finite.)
template <class Derived>
bool all_finite(const Eigen::DenseBase<Derived>& A) {
    return std::isfinite(A.sum()) || A.allFinite();
}

}  // namespace cardan
