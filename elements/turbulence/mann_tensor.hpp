/// @file
/// Spectral tensor of turbulence in uniform shear: isotropic turbulence of von Karman's spectrum whose eddies the shear
/// has turned and stretched for as long as they live [J. Mann, J. Fluid Mech. 273 (1994) 141-168].
///
/// Axes as everywhere in the wind: x downwind, y to the left, z up; k the vector of wave numbers, rad/m. With
///
///     R_ij(r) = <u_i(x) u_j(x + r)> = integral Phi_ij(k) exp(i k.r) d3k
///
/// eddies lean with the shear: what is higher lies further downwind, and reaches a fixed point earlier.
#pragma once

#include "mbs/base/types.hpp"

namespace cardan {

/// The three numbers of the tensor.
struct MannParameters {
    double gamma = 3.9;          ///< Gamma: how long eddies live, over the time of the shear; 0: isotropic
    double length_scale = 33.6;  ///< L of von Karman's spectrum, m
    double dissipation = 1;      ///< alpha epsilon^(2/3), m^(4/3)/s^2

    /// @throws InputError for a gamma that is negative or above 100, and for what is not finite and > 0 elsewhere
    void check() const;
    friend bool operator==(const MannParameters&, const MannParameters&) = default;
};

/// Parameters of IEC 61400-1: Gamma = 3.9, L = 0.8 Lambda_1 with Lambda_1 = 0.7 times the height of the hub, that of
/// 60 m at most, and the dissipation that gives isotropic turbulence a deviation of 0.55 sigma_1. The tensor's own
/// deviation of u then is 0.989 sigma_1.
/// @param hub_height  above the ground, m
/// @param sigma_1     standard deviation of u at the hub, m/s
/// @throws InputError unless both are finite and > 0
MannParameters iec_mann(double hub_height, double sigma_1);

/// Dissipation alpha epsilon^(2/3), m^(4/3)/s^2, that gives isotropic turbulence a deviation of sigma, m/s:
///
///     sigma^2 = B(5/2, 1/3)/3 alpha epsilon^(2/3) L^(2/3)
double dissipation_of_isotropic(double sigma, double length_scale);

/// Shear beta that eddies of the wave number k have seen in their life, as an angle: Gamma over (k L)^(2/3) and over
/// the root of the hypergeometric function 2F1(1/3, 17/6; 4/3; -(k L)^-2). The latter is an incomplete beta function,
///
///     beta = Gamma sqrt(3)/(k L sqrt(B_y(1/3, 5/2))),      y = 1/(1 + (k L)^2),
///
/// which has no cancellation.
/// @param kL  k L, > 0
double mann_shear(double kL, double gamma);

/// Phi_ij(k), m^5/s^2: real, symmetric, positive semidefinite; k_i Phi_ij = 0; zero at k = 0. At k_1 = 0 its limit.
Mat3 mann_tensor(const MannParameters& parameters, const Vec3& k);

/// A root of the tensor, Phi = A A^T, whose columns k is normal to: A n of three independent gaussians n is one wave of
/// the turbulence [J. Mann, Prob. Eng. Mech. 13 (1998) 269-282, eq. 46 without the volume].
Mat3 mann_root(const MannParameters& parameters, const Vec3& k);

}  // namespace cardan
