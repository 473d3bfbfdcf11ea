#include "elements/turbulence/spectrum_lines.hpp"

#include "elements/turbulence/detail/fourier.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cardan {

namespace {

constexpr int largest_series_factor = 100;

void check_series(const TimeSeries& series) {
    constexpr auto where = "time series";
    if (series.values.size() < 8) throw InputError(where, "number of values", series.values.size(), "at least 8");
    if (series.values.size() > std::size_t{1} << 28U)
        throw InputError(where, "number of values", series.values.size(), "at most 2^28");
    require_positive(where, "step [s]", series.step);
    for (const double value : series.values)
        if (!std::isfinite(value)) throw InputError(where, "value", value, "finite");
}

// The limits of bands, as numbers of lines: begin of each, and the end.
std::vector<std::size_t> band_limits(std::size_t lines, int per_decade) {
    if (per_decade < 1) throw InputError("bands of a spectrum", "number per decade", per_decade, ">= 1");
    std::vector<std::size_t> limits{0};
    const double ratio = std::pow(10, 1.0 / per_decade);
    for (std::size_t line = 0; line < lines;) {
        // Line i has the frequency (i + 1)/T.
        const double last = static_cast<double>(line + 1) * ratio - 1;
        line = std::min(lines, std::max(line + 1, static_cast<std::size_t>(std::floor(last))));
        limits.push_back(line);
    }
    return limits;
}

void require_same_lines(const char* where, std::size_t expected, std::size_t found) {
    if (expected != found) throw InputError(where, "number of lines", found, text(expected, ", as the others"));
}

}  // namespace

SpectrumLines spectrum_lines(const TimeSeries& series) {
    check_series(series);
    int n = static_cast<int>(series.values.size());
    const bool whole = detail::largest_factor(n) <= largest_series_factor;
    while (detail::largest_factor(n) > largest_series_factor) --n;
    const auto count = static_cast<std::size_t>(n);
    const std::span values(series.values.data(), count);
    const bool window = !series.periodic || !whole;

    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    std::vector<Complex> x(count), X(count);
    double squares = 0;
    for (std::size_t j = 0; j < count; ++j) {
        const double w = window ? 0.5 - 0.5 * std::cos(2 * pi * static_cast<double>(j) / n) : 1;
        x[j] = w * (values[j] - mean);
        squares += w * w;
    }
    detail::Fourier().forward(x.data(), n, X.data());

    SpectrumLines out;
    out.step = 1 / (n * series.step);
    const double size = std::sqrt(2 * series.step / squares);
    for (std::size_t k = 1; k <= count / 2; ++k) out.amplitudes.push_back(size * X[k]);
    if (n % 2 == 0) out.amplitudes.back() /= std::sqrt(2.0);
    return out;
}

double PowerSpectrum::variance() const {
    double sum = 0;
    for (std::size_t i = 0; i < density.size(); ++i) sum += density[i] * lines[i] * step;
    return sum;
}

PowerSpectrum power_spectrum(const SpectrumLines& lines) {
    PowerSpectrum out;
    out.step = lines.step;
    for (std::size_t k = 0; k < lines.amplitudes.size(); ++k) {
        out.frequency.push_back(lines.frequency(k));
        out.density.push_back(std::norm(lines.amplitudes[k]));
        out.lines.push_back(1);
    }
    return out;
}

PowerSpectrum mean_spectrum(std::span<const PowerSpectrum> spectra) {
    if (spectra.empty()) throw InputError("mean spectrum", "number of spectra", 0, "at least 1");
    PowerSpectrum out = spectra.front();
    for (const PowerSpectrum& other : spectra.subspan(1)) {
        require_same_lines("mean spectrum", out.density.size(), other.density.size());
        for (std::size_t i = 0; i < out.density.size(); ++i) out.density[i] += other.density[i];
    }
    for (double& density : out.density) density /= static_cast<double>(spectra.size());
    return out;
}

PowerSpectrum in_bands(const PowerSpectrum& spectrum, int per_decade) {
    const std::vector<std::size_t> limits = band_limits(spectrum.density.size(), per_decade);
    PowerSpectrum out;
    out.step = spectrum.step;
    for (std::size_t b = 0; b + 1 < limits.size(); ++b) {
        double frequency = 0, density = 0;
        int lines = 0;
        for (std::size_t i = limits[b]; i < limits[b + 1]; ++i) {
            frequency += spectrum.frequency[i] * spectrum.lines[i];
            density += spectrum.density[i] * spectrum.lines[i];
            lines += spectrum.lines[i];
        }
        out.frequency.push_back(frequency / lines);
        out.density.push_back(density / lines);
        out.lines.push_back(lines);
    }
    return out;
}

Coherence coherence(std::span<const SpectrumLines> lines, std::span<const SeriesPair> pairs, int per_decade) {
    constexpr auto where = "coherence";
    if (pairs.empty()) throw InputError(where, "number of pairs", 0, "at least 1");
    for (const SeriesPair& pair : pairs)
        if (pair.first >= lines.size() || pair.second >= lines.size())
            throw InputError(where, "number of a series", std::max(pair.first, pair.second),
                             text("below ", lines.size()));
    const std::size_t count = lines[pairs.front().first].amplitudes.size();
    for (const SpectrumLines& one : lines) require_same_lines(where, count, one.amplitudes.size());

    const std::vector<std::size_t> limits = band_limits(count, per_decade);
    Coherence out;
    for (std::size_t b = 0; b + 1 < limits.size(); ++b) {
        Complex cross = 0;
        double first = 0, second = 0, frequency = 0;
        for (std::size_t i = limits[b]; i < limits[b + 1]; ++i) {
            frequency += lines.front().frequency(i);
            for (const SeriesPair& pair : pairs) {
                const Complex one = lines[pair.first].amplitudes[i], other = lines[pair.second].amplitudes[i];
                cross += std::conj(one) * other;
                first += std::norm(one);
                second += std::norm(other);
            }
        }
        const double size = std::sqrt(first * second);
        out.frequency.push_back(frequency / static_cast<double>(limits[b + 1] - limits[b]));
        out.value.push_back(size > 0 ? cross / size : Complex(0));
        out.lines.push_back(static_cast<int>((limits[b + 1] - limits[b]) * pairs.size()));
    }
    return out;
}

}  // namespace cardan
