/// @file
/// Numbers that tests have in common, and how large differences are.
#pragma once

#include "mbs/base/types.hpp"

#include <cmath>
#include <limits>

namespace cardan::testing {

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinite = std::numeric_limits<double>::infinity();
/// Imaginary step of a derivative: without cancellation it may be as small as one likes.
inline constexpr double complex_step = 1e-40;

/// Largest absolute value of the elements; 0 if there are none.
inline double max_abs(const Matrix& m) {
    return m.size() ? m.cwiseAbs().maxCoeff() : 0.0;
}

/// Largest element of a difference, relative to what is compared where that is large.
inline double scaled(const Matrix& difference, const Matrix& reference) {
    return difference.cwiseAbs().maxCoeff() / (1 + reference.cwiseAbs().maxCoeff());
}

/// Largest element of A - B over the roots of B's diagonal elements of its row and column: a measure for matrices whose
/// elements have different units. Where B's is zero (a rigid direction) the difference counts as it is.
inline double scaled_difference(const Mat6& A, const Mat6& B) {
    const Vec6 d = B.diagonal().unaryExpr([](double b) { return b != 0 ? 1 / std::sqrt(std::abs(b)) : 1.0; });
    return (d.asDiagonal() * (A - B) * d.asDiagonal()).cwiseAbs().maxCoeff();
}

/// Order of convergence that is seen when the error falls from `coarse` to `fine` as the step is halved.
inline double observed_order(double coarse, double fine) {
    return std::log2(std::abs(coarse / fine));
}

}  // namespace cardan::testing
