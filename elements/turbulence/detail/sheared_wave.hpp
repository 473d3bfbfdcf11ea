/// @file
/// A wave of Mann's tensor: where it was before the shear, and what the shear did to it.
#pragma once

#include "mbs/base/types.hpp"

#include <cmath>

namespace cardan::detail {

/// Letters as in Mann (1994), eq. 3.16 to 3.20, with p = k_1^2 + k_2^2.
struct ShearedWave {
    double k1, k2, k3;
    double k_square;        ///< k^2
    double k30, k0_square;  ///< third component and square of the wave number before the shear
    double p;
    double zeta1 = 0, zeta2 = 0;  ///< 0 also where p = 0, as the tensor holds them times k_1, k_2 and p

    /// @param k  not zero
    ShearedWave(const Vec3& k, double beta)
        : k1(k(0)),
          k2(k(1)),
          k3(k(2)),
          k_square(k1 * k1 + k2 * k2 + k3 * k3),
          k30(k3 + beta * k1),
          k0_square(k1 * k1 + k2 * k2 + k30 * k30),
          p(k1 * k1 + k2 * k2) {
        if (p == 0) return;
        const double C1 = beta * k1 * k1 * (k0_square - 2 * k30 * k30 + beta * k1 * k30) / (k_square * p);
        const double root = std::sqrt(p), below = k0_square - k30 * k1 * beta;
        // atan2(...)/k_1, C_2 = k_1 k_2 k_0^2/p^(3/2) times this
        const double turn = k1 != 0 ? std::atan2(beta * k1 * root, below) / k1 : beta * root / below;
        const double C2 = k2 * k0_square / (p * root) * turn;
        zeta1 = C1 - k2 * C2;
        zeta2 = k1 != 0 ? k2 / k1 * C1 + k1 * C2 : 0;
    }
    /// The tensor over E(k_0)/(4 pi k_0^4).
    Mat3 tensor() const {
        Mat3 out;
        const double share = k0_square / k_square;
        out(0, 0) = k0_square - k1 * k1 - 2 * k1 * k30 * zeta1 + p * zeta1 * zeta1;
        out(1, 1) = k0_square - k2 * k2 - 2 * k2 * k30 * zeta2 + p * zeta2 * zeta2;
        out(2, 2) = p * share * share;
        out(0, 1) = out(1, 0) = -k1 * k2 - k1 * k30 * zeta2 - k2 * k30 * zeta1 + p * zeta1 * zeta2;
        out(0, 2) = out(2, 0) = share * (p * zeta1 - k1 * k30);
        out(1, 2) = out(2, 1) = share * (p * zeta2 - k2 * k30);
        return out;
    }
    /// The root of the tensor over that of an isotropic one.
    Mat3 root() const {
        const double share = k0_square / k_square;
        Mat3 out;
        out << k2 * zeta1, k30 - k1 * zeta1, -k2,  //
            k2 * zeta2 - k30, -k1 * zeta2, k1,     //
            k2 * share, -k1 * share, 0;
        return out;
    }
};

/// E(k_0)/(4 pi k_0^4) over alpha epsilon^(2/3) L^(17/3), of von Karman's spectrum.
inline double sheared_energy(double k0L_square) {
    return std::pow(1 + k0L_square, -17.0 / 6) / (4 * pi);
}

}  // namespace cardan::detail
