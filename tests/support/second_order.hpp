/// @file
/// Exponents of small systems of second order that a test writes down by hand.
#pragma once

#include "mbs/base/types.hpp"

#include <functional>
#include <vector>

namespace cardan::testing {

/// Exponents of M q'' + C q' + K q = 0.
std::vector<Complex> eigenvalues(const Matrix& M, const Matrix& C, const Matrix& K);

/// M, C and K, n x n, at an azimuth.
using Coefficients = std::function<void(double psi, Matrix& M, Matrix& C, Matrix& K)>;
/// Exponents of M(psi) q'' + C(psi) q' + K(psi) q = 0 with psi = Omega t, imaginary parts modulo Omega: a turn by the
/// classical Runge-Kutta method.
std::vector<Complex> exponents(const Coefficients& at, Eigen::Index n, double Omega, int steps);

}  // namespace cardan::testing
