#include "solvers/signals/spectrum.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/types.hpp"
#include "solvers/algebra/fft.hpp"
#include "solvers/signals/sampling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace cardan::solvers {

namespace {

constexpr const char* in_spectrum = "spectrum";

// One period of w(j) = sum_m (-1)^m a_m cos(2 pi m j/n), so that averages of shifted segments have no ripple.
std::vector<double> samples_of(Window window, std::size_t n) {
    std::array<double, 5> a{1, 0, 0, 0, 0};
    if (window == Window::hann) a = {0.5, 0.5, 0, 0, 0};
    // [D'Antona and Ferrero, Digital Signal Processing for Measurement Systems (2006), p. 72]
    if (window == Window::flat_top) a = {0.21557895, 0.41663158, 0.277263158, 0.083578947, 0.006947368};
    std::vector<double> w(n, 0.0);
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t m = 0; m < a.size(); ++m) {
            const double angle = 2 * pi * static_cast<double>(m * j) / static_cast<double>(n);
            w[j] += (m % 2 == 0 ? a[m] : -a[m]) * std::cos(angle);
        }
    return w;
}

void remove_trend(std::vector<double>& x, Detrend detrend) {
    if (detrend == Detrend::none) return;
    const auto n = static_cast<double>(x.size());
    const double mean = std::accumulate(x.begin(), x.end(), 0.0) / n;
    for (double& value : x) value -= mean;
    if (detrend == Detrend::mean) return;
    // Line through the mean at the middle; sum of (j - (n-1)/2)^2 = n (n^2 - 1)/12.
    double moment = 0;
    for (std::size_t j = 0; j < x.size(); ++j) moment += (static_cast<double>(j) - (n - 1) / 2) * x[j];
    const double slope = 12 * moment / (n * (n * n - 1));
    for (std::size_t j = 0; j < x.size(); ++j) x[j] -= slope * (static_cast<double>(j) - (n - 1) / 2);
}

void check(std::span<const double> time, std::span<const double> values) {
    if (values.size() != time.size())
        throw InputError(in_spectrum, "number of values", values.size(), text(time.size(), ", that of the times"));
    const TimeSteps steps = time_steps(time);
    if (!steps.uniform())
        throw InputError(in_spectrum, text("deviation from equal steps at ", steps.deviates_at, " s"),
                         text(steps.largest_deviation, " of a step"), "at most 0.001; resample() makes equal steps");
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::isfinite(values[i]))
            throw InputError(in_spectrum, text("value at ", time[i], " s"), values[i], "finite");
}

std::size_t segment_length(double seconds, double step, std::size_t samples) {
    if (samples < 8) throw InputError(in_spectrum, "number of samples", samples, "at least 8");
    const double length = seconds == 0 ? static_cast<double>(samples) : std::round(seconds / step);
    if (!(length >= 8 && length <= static_cast<double>(samples)))
        throw InputError(in_spectrum, "segment [s]", seconds,
                         text(8 * step, " (8 samples) to ", static_cast<double>(samples) * step, " (all samples)"));
    return static_cast<std::size_t>(length);
}

}  // namespace

double Spectrum::variance(double from, double to) const {
    double sum = 0;
    for (std::size_t k = 0; k < frequency.size(); ++k)
        if (frequency[k] >= from && frequency[k] <= to) sum += density[k] * step;
    return sum;
}

Spectrum spectrum(std::span<const double> time, std::span<const double> values, const SpectrumOptions& options) {
    if (!(options.overlap >= 0 && options.overlap < 1))
        throw InputError(in_spectrum, "overlap", options.overlap, "0 <= overlap < 1");
    if (!(options.segment >= 0)) throw InputError(in_spectrum, "segment [s]", options.segment, ">= 0; 0: all samples");
    const SampleRange range = samples_between(time, options.from, options.to);
    if (values.size() == time.size()) values = values.subspan(range.first, range.count);
    time = time.subspan(range.first, range.count);
    check(time, values);
    const double dt = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
    const std::size_t n = segment_length(options.segment, dt, time.size());
    const auto hop =
        std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(static_cast<double>(n) * (1 - options.overlap))));

    const std::vector<double> w = samples_of(options.window, n);
    double sum = 0, sum_squares = 0;
    for (double value : w) sum += value, sum_squares += value * value;
    RealFourier fourier(n);
    std::vector<double> x(n), power(fourier.frequencies(), 0.0);
    std::vector<std::complex<double>> X(fourier.frequencies());
    Spectrum s;
    for (std::size_t begin = 0; begin + n <= values.size(); begin += hop, ++s.segments) {
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(begin), n, x.begin());
        remove_trend(x, options.detrend);
        for (std::size_t j = 0; j < n; ++j) x[j] *= w[j];
        fourier.transform(x, X);
        for (std::size_t k = 0; k < power.size(); ++k) power[k] += std::norm(X[k]);
    }
    s.step = 1 / (static_cast<double>(n) * dt);
    s.noise_bandwidth = sum_squares / (sum * sum * dt);
    for (std::size_t k = 0; k < power.size(); ++k) {
        const bool alone = k == 0 || 2 * k == n;  // no partner at the negative frequency
        const double mean = power[k] / s.segments;
        s.frequency.push_back(static_cast<double>(k) * s.step);
        s.amplitude.push_back((alone ? 1 : 2) * std::sqrt(mean) / sum);
        s.density.push_back((alone ? 1 : 2) * mean * dt / sum_squares);
    }
    return s;
}

Spectrum spectrum(const History& history, std::string_view channel, const SpectrumOptions& options) {
    const std::size_t i = history.index(channel);
    try {
        Spectrum s = spectrum(history.time, history.values[i], options);
        s.channel = history.channels[i].name;
        s.units = history.channels[i].units;
        return s;
    } catch (const InputError& error) {
        throw InputError(text("channel '", history.channels[i].name, "': ", error.what()));
    }
}

std::vector<Peak> peaks(const Spectrum& spectrum, std::size_t count, double threshold) {
    if (!(threshold >= 0 && threshold <= 1))
        throw InputError("peaks of a spectrum", "threshold", threshold, "0 <= threshold <= 1");
    const std::vector<double>& a = spectrum.amplitude;
    std::vector<Peak> found;
    for (std::size_t k = 1; k + 1 < a.size(); ++k) {
        if (!(a[k] > a[k - 1] && a[k] >= a[k + 1])) continue;
        // Neighbours that are rounding noise must not pull the parabola.
        const double left = std::log(std::max(a[k - 1] / a[k], 1e-8)),
                     right = std::log(std::max(a[k + 1] / a[k], 1e-8));
        const double offset = (left - right) / (2 * (left + right));
        found.push_back(
            {(static_cast<double>(k) + offset) * spectrum.step, a[k] * std::exp((right - left) * offset / 4)});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Peak& x, const Peak& y) { return x.amplitude > y.amplitude; });
    while (!found.empty() && (found.size() > count || found.back().amplitude < threshold * found.front().amplitude))
        found.pop_back();
    return found;
}

}  // namespace cardan::solvers
