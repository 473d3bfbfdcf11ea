/// @file
/// MAC of motions with periodic shapes.
#pragma once

#include "solvers/campbell_data/diagram.hpp"

namespace cardan::solvers {

/// A row per mode of one point, a column per mode of another; 0 ... 1.
struct PeriodicMac {
    /// Complex energy MAC of all harmonics, |xy|^2 / (xx yy) with the energy product
    ///
    ///     xy = sum_j x_j^H K_e y_(j+s) + conj(lambda_xj) lambda_y(j+s) x_j^H M y_(j+s),
    ///
    /// for the shift s = -2 ... 2 that makes it largest: the principal harmonic may change from one point to the next.
    /// At low frequencies y's complex conjugate is tried as well. A rigid motion, which has no energy, is compared only
    /// with motions without elastic energy, and by shape: sum_j x_j^H M y_(j+s).
    Matrix mac;
    /// The score used for tracking: the largest of the MAC without shift, the MAC of the principal harmonics alone, and
    /// a quarter of the MAC with a shift. Two modes whose exponents meet modulo the rotor speed exchange harmonics, as
    /// veering modes exchange shapes; but their principal frequencies, which are plotted, are far apart and do not
    /// veer, so the branches continue unchanged there.
    Matrix score;
};

/// @param weights  mean of M and K_elastic over the azimuth
PeriodicMac periodic_mac(const SecondOrderSystem& weights, const std::vector<const CampbellMode*>& before,
                         const std::vector<CampbellMode>& now);

}  // namespace cardan::solvers
