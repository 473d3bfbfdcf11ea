/// @file
/// Fourier series of vectors over the azimuth.
#pragma once

#include "mbs/base/types.hpp"

namespace cardan::solvers {

/// (1, cos psi, sin psi, cos 2 psi, ...) or one of its derivatives by psi; 2 harmonics + 1 entries. A series is a
/// matrix with one column per entry; its value is the product of the two.
Vector fourier_basis(double psi, int harmonics, int derivative = 0);

/// Weights with which a sample at psi, one of `count` equidistant ones, enters the coefficients of the series. Exact
/// for series of up to `harmonics` harmonics if count > 2 harmonics.
Vector fourier_weights(double psi, int harmonics, int count);

/// Coefficients of the series through equidistant samples (one per column, from azimuth 0 on).
Matrix fourier_coefficients(const Matrix& samples, int harmonics);
/// Coefficients of exp(i j psi), j = -J ... J by column, of every row, as many as the samples tell apart: J = (samples
/// - 1) / 2.
ComplexMatrix fourier_coefficients(const ComplexMatrix& samples);

}  // namespace cardan::solvers
