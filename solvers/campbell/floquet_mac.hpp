/// @file
/// Likeness of motions with periodic shapes.
#pragma once

#include "solvers/campbell/diagram.hpp"

namespace cardan::solvers {

/// A row per mode of one point, a column per mode of another; 0 ... 1.
struct PeriodicLikeness {
    /// Complex energy MAC of all harmonics, |xy|^2 / (xx yy) with the energy product
    ///   xy = sum_j x_j^H K_e y_(j+s) + conj(lambda_xj) lambda_y(j+s) x_j^H M y_(j+s),
    /// for the shift s = -2 ... 2 that makes it largest: the principal harmonic may change from one point to the next.
    /// At low frequencies y's complex conjugate is tried as well. Where a rigid motion is concerned, which has no
    /// energy, only motions without elastic energy are compared, and by their shapes: sum_j x_j^H M y_(j+s).
    Matrix mac;
    /// What modes are followed by: the largest of the MAC without shift, of what the principal harmonics alone make of
    /// it, and of a quarter of the MAC with a shift. Two modes whose exponents meet but for a multiple of the rotor
    /// speed exchange their harmonics as any veering modes exchange their shapes; but their principal frequencies,
    /// which are drawn, are far apart and do not veer: there the branches go on as they were.
    Matrix score;
};

/// @param weights  mean of M and K_elastic over the azimuth
PeriodicLikeness periodic_likeness(const SecondOrderSystem& weights, const std::vector<const CampbellMode*>& before,
                                   const std::vector<CampbellMode>& now);

}  // namespace cardan::solvers
