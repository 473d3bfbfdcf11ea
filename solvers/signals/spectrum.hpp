/// @file
/// Amplitude spectra and power spectral densities of recorded channels, and their peaks.
#pragma once

#include "solvers/signals/history.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cardan::solvers {

/// What a segment is multiplied by before it is transformed.
enum class Window : std::uint8_t {
    rectangular,  ///< nothing; exact for whole periods, leaks far otherwise
    hann,         ///< for frequencies and densities: leaks little; reads up to 15 % low between two frequencies
    flat_top,     ///< for amplitudes: within 0.2 % everywhere, peaks five frequencies wide
};

/// What is taken from a segment before.
enum class Detrend : std::uint8_t { none, mean, linear };

struct SpectrumOptions {
    Window window = Window::hann;
    Detrend detrend = Detrend::mean;
    /// s; several segments are averaged, which smooths noise and widens peaks. 0: all samples in one segment.
    double segment = 0;
    double overlap = 0.5;  ///< part of a segment that the next one has in common with it
    double from = -std::numeric_limits<double>::infinity();  ///< s, what lies before is left out
    double to = std::numeric_limits<double>::infinity();     ///< s
};

/// One-sided spectrum, 0 to half the sampling frequency.
struct Spectrum {
    std::string channel;
    std::string units;              ///< of the amplitudes: those of the channel
    std::vector<double> frequency;  ///< Hz
    std::vector<double> amplitude;  ///< a sinusoid of amplitude A reads A at its frequency; quadratic mean of segments
    std::vector<double> density;    ///< units^2/Hz; its integral is the variance
    double step = 0;                ///< Hz between frequencies: 1/length of a segment
    double noise_bandwidth = 0;     ///< Hz; amplitude^2/2 = density * noise_bandwidth
    int segments = 0;

    /// Integral of the density over a band of frequencies, Hz: the part of the variance that lies in it, units^2.
    double variance(double from = 0, double to = std::numeric_limits<double>::infinity()) const;
};

/// Averaged modified periodograms [Welch, IEEE Trans. Audio Electroacoust. 15 (1967) 70-73]. Samples at the end that
/// fill no segment are left out. Time O(n log n) for every number of samples.
/// @param time    s, in equal steps (see TimeSteps)
/// @param values  finite
/// @throws InputError for unequal steps (resample() makes them equal), values that are not finite, a segment with fewer
///         than 8 samples or longer than the history, an overlap outside 0 <= overlap < 1
Spectrum spectrum(std::span<const double> time, std::span<const double> values, const SpectrumOptions& options = {});
/// Of a channel, by name or alias.
Spectrum spectrum(const History& history, std::string_view channel, const SpectrumOptions& options = {});

struct Peak {
    double frequency = 0;  ///< Hz
    double amplitude = 0;  ///< units of the channel
};

/// Local maxima, the largest first, by the parabola through three logarithms of the amplitude. Of a sinusoid seen
/// through the Hann window this finds the frequency within 0.016 steps of the spectrum and the amplitude within 0 and
/// +3.9 %.
/// @param threshold  peaks below this part of the largest one are left out; side lobes of the Hann window have 0.027
/// @throws InputError for a threshold outside 0 <= threshold <= 1
std::vector<Peak> peaks(const Spectrum& spectrum, std::size_t count = 10, double threshold = 0.05);

}  // namespace cardan::solvers
