/// @file
/// Turbulence of Kaimal's spectra with exponential coherence, as in IEC 61400-1.
#pragma once

#include "mbs/base/types.hpp"

#include <cstdint>

namespace cardan {

/// Whether v and w at different points are coherent; the standard has a coherence for u alone.
enum class TransverseCoherence : std::uint8_t {
    as_u,  ///< that of u
    none   ///< none between any two points, TurbSim's default
};

/// One-sided spectra of the components u, v, w (downwind, to the left, upward; number 0, 1, 2) and their coherence
/// between two points at a distance d across the wind, the same at all heights:
///
///     S_k(f) = 4 sigma_k^2 (L_k/V) / (1 + 6 f L_k/V)^(5/3),   the integral of which is sigma_k^2
///     gamma(f, d) = exp(-c [(f d/V)^2 + (b d/L_c)^2]^(1/2))
///
/// [IEC 61400-1, annexes B and C of editions 3 and 4; J. C. Kaimal, J. C. Wyngaard, Y. Izumi, O. R. Cote, Q. J. R.
/// Meteorol. Soc. 98 (1972) 563]. gamma is real and not squared: the cross spectrum of one component at two points is
/// gamma S_k. Different components are independent.
struct Kaimal {
    double speed = 0;               ///< V, the mean at hub height, m/s
    Vec3 deviation = Vec3::Zero();  ///< sigma_k, m/s
    Vec3 length = Vec3::Zero();     ///< L_k, m
    double coherence_length = 0;    ///< L_c, m
    double decay = 12;              ///< c
    double offset = 0.12;           ///< b
    TransverseCoherence transverse = TransverseCoherence::as_u;

    /// S_k(f), m^2/s^2 per Hz.
    double spectrum(int component, double frequency) const;
    /// gamma of u.
    double coherence(double frequency, double distance) const;
    /// The rate with which gamma of u falls over a distance: gamma = exp(-decay_rate(f) d), 1/m.
    double decay_rate(double frequency) const;
    /// Variance of a series of so many steps, that is sum S_k(j/T)/T over its lines j = 1 ... steps/2, T = steps
    /// time_step: less than sigma_k^2, m^2/s^2.
    double variance_of_lines(int component, int steps, double time_step) const;
    /// @throws InputError for a speed, deviations, lengths, a decay that are not positive, or a negative offset
    void check() const;
};

/// Kaimal turbulence of the standard: sigma_k = sigma_1 (1, 0.8, 0.5), L_k = Lambda_1 (8.1, 2.7, 0.66),
/// L_c = 8.1 Lambda_1.
/// @param speed       mean at hub height, m/s
/// @param deviation   sigma_1, of u, m/s
/// @param hub_height  m
/// @throws InputError for what is not positive
Kaimal kaimal_turbulence(double speed, double deviation, double hub_height);

}  // namespace cardan
