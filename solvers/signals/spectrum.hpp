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

/// Window applied to a segment before it is transformed.
enum class Window : std::uint8_t {
    rectangular,  ///< no window; exact for whole periods, leaks widely otherwise
    hann,         ///< for frequencies and densities: little leakage; reads up to 15 % low between two frequency lines
    flat_top,     ///< for amplitudes: within 0.2 % everywhere, peaks five frequency lines wide
};

/// Part that is subtracted from a segment first.
enum class Detrend : std::uint8_t { none, mean, linear };

struct SpectrumOptions {
    Window window = Window::hann;
    Detrend detrend = Detrend::mean;
    /// s; several segments are averaged, which smooths noise and widens peaks. 0: all samples in one segment.
    double segment = 0;
    double overlap = 0.5;                                    ///< fraction of a segment shared with the next one
    double from = -std::numeric_limits<double>::infinity();  ///< s, earlier samples are left out
    double to = std::numeric_limits<double>::infinity();     ///< s
};

/// One-sided spectrum, 0 to half the sampling frequency.
struct Spectrum {
    std::string channel;
    std::string units;              ///< of the amplitudes: those of the channel
    std::vector<double> frequency;  ///< Hz
    std::vector<double> amplitude;  ///< a sinusoid of amplitude A reads A at its frequency; RMS over segments
    std::vector<double> density;    ///< units^2/Hz; its integral is the variance
    double step = 0;                ///< frequency resolution, Hz: 1 / segment length
    double noise_bandwidth = 0;     ///< Hz; amplitude^2/2 = density * noise_bandwidth
    int segments = 0;

    /// Integral of the density over a band of frequencies, Hz: the part of the variance that lies in it, units^2.
    double variance(double from = 0, double to = std::numeric_limits<double>::infinity()) const;
};

/// Averaged modified periodograms [Welch, IEEE Trans. Audio Electroacoust. 15 (1967) 70-73]. Samples at the end that do
/// not fill a segment are left out. Time O(n log n) for any number of samples.
/// @param time    s, in equal steps (see TimeSteps)
/// @param values  finite
/// @throws InputError for unequal steps (resample() makes them equal), values that are not finite, a segment with fewer
///         than 8 samples or longer than the history, an overlap outside 0 <= overlap < 1
Spectrum spectrum(std::span<const double> time, std::span<const double> values, const SpectrumOptions& options = {});
/// Spectrum of a channel, by name or alias.
Spectrum spectrum(const History& history, std::string_view channel, const SpectrumOptions& options = {});

struct Peak {
    double frequency = 0;  ///< Hz
    double amplitude = 0;  ///< units of the channel
};

/// Local maxima, largest first, refined by the parabola through three log amplitudes. For a sinusoid with the Hann
/// window this finds the frequency within 0.016 steps of the spectrum and the amplitude within 0 and +3.9 %.
/// @param threshold  peaks below this fraction of the largest one are left out; side lobes of the Hann window reach
///                   0.027
/// @throws InputError for a threshold outside 0 <= threshold <= 1
std::vector<Peak> peaks(const Spectrum& spectrum, std::size_t count = 10, double threshold = 0.05);

}  // namespace cardan::solvers
