#include "solvers/signals/sampling.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan::solvers {

namespace {

constexpr const char* in_time_history = "time history";

void check_rising(std::span<const double> time) {
    if (time.size() < 2) throw InputError(in_time_history, "number of samples", time.size(), "at least 2");
    for (std::size_t i = 0; i < time.size(); ++i) {
        if (!std::isfinite(time[i])) throw InputError(in_time_history, text("time of sample ", i), time[i], "finite");
        if (i > 0 && !(time[i] > time[i - 1]))
            throw InputError(in_time_history, text("time of sample ", i), time[i],
                             text("> ", time[i - 1], ", that before it"));
    }
}

// Slope of the parabola through samples i - 1, i, i + 1, at the ends through the three next to them.
double slope(std::span<const double> t, std::span<const double> y, std::size_t i) {
    const std::size_t n = t.size();
    if (n == 2) return (y[1] - y[0]) / (t[1] - t[0]);
    const std::size_t m = std::clamp<std::size_t>(i, 1, n - 2);
    const double h0 = t[m] - t[m - 1], h1 = t[m + 1] - t[m];
    const double d0 = (y[m] - y[m - 1]) / h0, d1 = (y[m + 1] - y[m]) / h1;
    const double curvature = (d1 - d0) / (h0 + h1);
    return d0 + curvature * (h0 + 2 * (t[i] - t[m]));
}

}  // namespace

TimeSteps time_steps(std::span<const double> time) {
    check_rising(time);
    TimeSteps steps;
    steps.mean = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
    std::vector<double> length;
    length.reserve(time.size() - 1);
    for (std::size_t i = 1; i < time.size(); ++i) {
        length.push_back(time[i] - time[i - 1]);
        const double expected = time.front() + static_cast<double>(i) * steps.mean;
        const double deviation = std::abs(time[i] - expected) / steps.mean;
        if (deviation <= steps.largest_deviation) continue;
        steps.largest_deviation = deviation;
        steps.deviates_at = time[i];
    }
    const auto middle = length.begin() + static_cast<std::ptrdiff_t>(length.size() / 2);
    std::nth_element(length.begin(), middle, length.end());
    steps.median = *middle;
    steps.largest = *std::max_element(length.begin(), length.end());
    return steps;
}

SampleRange samples_between(std::span<const double> time, double from, double to) {
    for (const auto& [name, value] : {std::pair{"from [s]", from}, std::pair{"to [s]", to}})
        if (std::isnan(value)) throw InputError(in_time_history, name, value, "a time, or infinite: no limit");
    const double size = time.empty() ? 0.0 : std::max(std::abs(time.front()), std::abs(time.back()));
    const double rounding = 1e-12 * size;
    const auto first = std::lower_bound(time.begin(), time.end(), from - rounding);
    const auto last = std::upper_bound(first, time.end(), to + rounding);
    if (last - first < 2)
        throw InputError(in_time_history, "from, to [s]", text(from, ", ", to),
                         time.empty() ? std::string("a history with samples")
                                      : text("two samples at least between ", time.front(), " and ", time.back()));
    return {static_cast<std::size_t>(first - time.begin()), static_cast<std::size_t>(last - first)};
}

std::vector<double> resample(std::span<const double> time, std::span<const double> values, std::span<const double> at) {
    check_rising(time);
    if (values.size() != time.size())
        throw InputError(in_time_history, "number of values", values.size(), text(time.size(), ", that of the times"));
    std::vector<double> result;
    result.reserve(at.size());
    std::size_t i = 0;  // piece from sample i to i + 1
    for (std::size_t k = 0; k < at.size(); ++k) {
        const double t = at[k];
        if (!(t >= time.front() && t <= time.back()) || (k > 0 && t < at[k - 1]))
            throw InputError(in_time_history, "time to resample at [s]", t,
                             text("rising, between ", time.front(), " and ", time.back()));
        while (i + 2 < time.size() && t >= time[i + 1]) ++i;
        const double h = time[i + 1] - time[i], s = (t - time[i]) / h, r = 1 - s;
        const double m0 = slope(time, values, i), m1 = slope(time, values, i + 1);
        result.push_back(r * r * (1 + 2 * s) * values[i] + s * s * (1 + 2 * r) * values[i + 1] +
                         h * s * r * (r * m0 - s * m1));
    }
    return result;
}

History resample(const History& history, double step) {
    check_rising(history.time);
    require_positive(in_time_history, "time between samples [s]", step);
    const double steps = (history.time.back() - history.time.front()) / step;
    if (!(steps < 1e8)) throw InputError(in_time_history, "number of samples", steps, "at most 1e8");
    History result{history.title, history.channels, {}, {}};
    const auto count = static_cast<std::size_t>(steps * (1 + 1e-12) + 1e-9) + 1;
    result.time.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        result.time.push_back(std::min(history.time.front() + static_cast<double>(i) * step, history.time.back()));
    for (const std::vector<double>& values : history.values)
        result.values.push_back(resample(history.time, values, result.time));
    return result;
}

}  // namespace cardan::solvers
