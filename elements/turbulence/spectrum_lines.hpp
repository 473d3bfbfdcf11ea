/// @file
/// Spectra, cross-spectra and coherence of series in equal steps of time, one-sided, in Hz.
#pragma once

#include "mbs/base/types.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace cardan {

/// Values in equal steps of time.
struct TimeSeries {
    std::vector<double> values;
    double step = 0;  ///< s
    /// Whether the first value follows the last one: the spectrum is then that of the lines, and exact. Else the values
    /// are weighted with a Hann window, as the step from the end to the beginning would be in all lines.
    bool periodic = false;
};

/// Amplitudes of a series about its mean at the lines f_k = k/T, k = 1 ... n/2, where |amplitude|^2 is its one-sided
/// spectral density. Amplitudes of several series of one length have cross-spectra conj(a) b.
struct SpectrumLines {
    std::vector<Complex> amplitudes;  ///< units of the series per root of Hz
    double step = 0;                  ///< 1/T, Hz

    double frequency(std::size_t line) const { return static_cast<double>(line + 1) * step; }
};

/// Transforms a series:
///
///     a_k = (2 dt/sum w_j^2)^(1/2) sum_j w_j (x_j - mean) exp(-2 pi i j k/n)
///
/// without the 2 at half the sampling rate, w_j = 1 or the Hann window. Of a periodic series sum |a_k|^2/T is the
/// variance (Parseval). Where the number of values has a prime factor above 100, some values at the end are left out,
/// and the rest is windowed.
/// @throws InputError for fewer than 8 values, a step that is not positive and values that are not finite
SpectrumLines spectrum_lines(const TimeSeries& series);

/// A one-sided power spectral density.
struct PowerSpectrum {
    std::vector<double> frequency;  ///< Hz, rising
    std::vector<double> density;    ///< square of the series' units per Hz
    std::vector<int> lines;         ///< of which each value is the mean
    double step = 0;                ///< between lines, Hz

    /// The sum of the density over all lines, times their distance: the variance of a periodic series.
    double variance() const;
};

/// The density of each line.
PowerSpectrum power_spectrum(const SpectrumLines& lines);
/// The mean of spectra of the same lines.  @throws InputError for none, and for different lines
PowerSpectrum mean_spectrum(std::span<const PowerSpectrum> spectra);
/// The means over bands of equal width on a logarithmic axis, at least one line each; frequencies are likewise means.
/// @param per_decade  number of bands, >= 1
PowerSpectrum in_bands(const PowerSpectrum& spectrum, int per_decade);

/// The coherence of two points over frequency is complex and not squared:
///
///     gamma = S_12/sqrt(S_11 S_22),      each S a mean over lines and over pairs of points
///
/// A positive phase says that the second series leads. One line of one pair has |gamma| = 1, whatever the series: only
/// the mean over many says something. |gamma| of n independent values scatters about 1/sqrt(n), the real part about 0.
struct Coherence {
    std::vector<double> frequency;  ///< Hz, of bands
    std::vector<Complex> value;
    std::vector<int> lines;  ///< of each band, of all pairs
};

/// A pair of series, by their numbers.
struct SeriesPair {
    std::size_t first = 0, second = 0;
};
/// The coherence of pairs of series that are alike, as of points at the same distance, in bands as in_bands().
/// @param lines  of each series, all of one length
/// @throws InputError for no pairs, a number of a series that there is not, and lines of different length
Coherence coherence(std::span<const SpectrumLines> lines, std::span<const SeriesPair> pairs, int per_decade);

}  // namespace cardan
