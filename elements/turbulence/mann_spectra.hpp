/// @file
/// Mann's tensor at points: spectra, cross-spectra, variances, by quadrature.
#pragma once

#include "elements/turbulence/mann_tensor.hpp"

namespace cardan {

/// Spectra F_ij(k_1) at a point, m^3/s^2: two-sided, the integral over all k_1 is the covariance of u_i and u_j. The
/// imaginary part, and with it F_uv and F_vw, is zero. Relative error 1e-6 for k_1 L from 1e-3 to 1e3.
/// @param k1  wave number downwind, rad/m
/// @throws InputError unless k1 is finite and > 0
Mat3 mann_spectrum(const MannParameters& parameters, double k1);

/// Cross-spectra F_ij(k_1) of u_i at one point and u_j at another that lies dy further to the left and dz higher,
/// m^3/s^2, two-sided:
///
///     F_ij = integral Phi_ij(k) exp(i(k_2 dy + k_3 dz)) dk_2 dk_3
///
/// A negative phase says that the second point's eddies lie further downwind. Error 1e-6 of sqrt(F_ii F_jj) at a point.
/// @param k1      wave number downwind, rad/m
/// @param dy, dz  m
/// @throws InputError unless k1 is finite and > 0 and the distances are finite
Mat3T<Complex> mann_cross_spectrum(const MannParameters& parameters, double k1, double dy, double dz);

/// Spectra over time at a point that frozen turbulence passes, S_ij(f) = 2 (2 pi/V) F_ij(2 pi f/V), m^2/s: one-sided,
/// the integral over f > 0 is the covariance.
/// @param frequency  f, Hz
/// @param speed      V, m/s
/// @throws InputError unless both are finite and > 0
Mat3 mann_spectrum_over_time(const MannParameters& parameters, double frequency, double speed);

/// Covariances of u, v, w at a point, m^2/s^2: the integral of the tensor over all wave numbers, to 1e-5 of the
/// variance of u. With Gamma = 3.9 the deviations are 1.797, 1.281 and 0.936 times those of isotropic turbulence.
Mat3 mann_covariance(const MannParameters& parameters);

}  // namespace cardan
