#pragma once

#include <complex>

namespace cardan::oracles {

/// y'' + (a - 2 q cos 2t) y = 0. Multipliers over pi are exp(+-i pi nu) with
///   cos(pi nu) = 1 - 2 Delta(0) sin^2(pi sqrt(a) / 2),
/// Delta(0) Hill's determinant, tridiagonal with 1 on the diagonal and q / (4 n^2 - a) beside it in row n.
/// [Whittaker and Watson, A Course of Modern Analysis, 19.42; DLMF 28.29]
/// Not for a = 4 n^2. Rows |n| <= 3000; the remainder falls like q^2 / n^3.
double mathieu_cosine(double a, double q);

/// Characteristic exponent i nu: y = exp(i nu t) times a function of period pi. Real part >= 0; imaginary part in
/// [0, 1], modulo sign and 2.
std::complex<double> mathieu_exponent(double a, double q);

}  // namespace cardan::oracles
