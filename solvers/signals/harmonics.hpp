/// @file
/// Mean value and harmonics of a periodic channel.
#pragma once

#include <span>
#include <vector>

namespace cardan::solvers {

/// y = mean + sum_k amplitude_k cos(2 pi k t/T + phase_k), k = 1, 2 ...
struct Harmonics {
    double base_frequency = 0;      ///< 1/T, Hz
    double mean = 0;                ///< in the units of the values, like amplitudes and rest
    std::vector<double> amplitude;  ///< >= 0; entry k - 1 belongs to harmonic k
    std::vector<double> phase;      ///< rad, -pi < phase <= pi, at t = 0 of the history's time
    double rest = 0;                ///< RMS of the remainder: noise, other frequencies, transients
    double from = 0, to = 0;        ///< s, first and last sample used
    int periods = 0;                ///< number of whole periods used

    /// The sum of the harmonics at a time, s.
    double operator()(double time) const;
};

/// Least-squares fit over the largest number of whole periods that end with the last sample; earlier samples (e.g.
/// transients) are ignored. The steps between the samples need not be equal. Time O(n count^2).
/// @param time            s, strictly rising
/// @param base_frequency  Hz, of the rotor for instance
/// @param count           number of harmonics
/// @throws InputError for a history shorter than a period, steps in it as long as half a period of the highest
/// harmonic,
///         values that are not finite, a frequency that is not positive, count < 1
Harmonics harmonics(std::span<const double> time, std::span<const double> values, double base_frequency, int count);

}  // namespace cardan::solvers
