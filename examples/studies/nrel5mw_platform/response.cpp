#include "examples/studies/nrel5mw_platform/response.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardan::platform {

namespace {

bool is_multiple(double whole, double part) {
    const double ratio = whole / part;
    return std::abs(ratio - std::round(ratio)) < 1e-9 * ratio;
}

// Largest difference of some channels between two periods, at every `stride`-th row.
double change(const solvers::History& before, const solvers::History& now, const std::vector<std::string>& channels,
              std::size_t stride) {
    if (before.values.empty()) return std::numeric_limits<double>::infinity();
    double largest = 0;
    for (const std::string& channel : channels) {
        const std::vector<double>&a = before[channel], &b = now[channel];
        for (std::size_t i = 0; i < b.size(); i += stride) largest = std::max(largest, std::abs(b[i] - a[i]));
    }
    return largest;
}

// No smaller change in the last 30 periods than in the 30 before them: the noise of the integration, or no damping.
bool has_stalled(const std::vector<double>& changes) {
    constexpr std::ptrdiff_t window = 30;
    if (changes.size() < 2 * window) return false;
    return *std::min_element(changes.end() - window, changes.end()) >
           0.9 * *std::min_element(changes.end() - 2 * window, changes.end() - window);
}

}  // namespace

double common_period(const std::vector<double>& periods) {
    if (periods.empty()) throw InputError("common period", "motions", "none that oscillates", "a rotor speed or one");
    const double longest = *std::ranges::max_element(periods);
    for (int m = 1; m <= 40; ++m)
        if (std::ranges::all_of(periods, [&](double period) { return is_multiple(m * longest, period); }))
            return m * longest;
    std::string list;
    for (double period : periods) list += text(list.empty() ? "" : ", ", period);
    throw InputError("common period", "periods [s]", list,
                     "with a common multiple of at most 40 times the longest (revolutions=N is exact)");
}

Response periodic_response(solvers::Integrator& integrator, solvers::Recorder& recorder, const ResponseOptions& options,
                           const solvers::RecordRow& row) {
    constexpr int compared = 48;  // rows of a period
    const double T = options.period;
    const int stride = std::max(1, static_cast<int>(std::ceil(T / options.step / compared)));
    Response response;
    const auto run = [&](int rows, solvers::History& into) {
        const double start = integrator.time();
        std::vector<double> times;
        for (int i = 0; i <= rows; ++i) times.push_back(start + T * i / rows);
        into.channels = recorder.channels();
        into.values.resize(into.channels.size());
        const solvers::Advance end =
            solvers::record(integrator, recorder, times, [&](double time, const std::vector<double>& values) {
                row(time, values);
                into.time.push_back(time);
                for (std::size_t i = 0; i < values.size(); ++i) into.values[i].push_back(values[i]);
            });
        require_result(end);
        return end.reached();
    };
    solvers::History before;
    for (int period = 1; period <= options.max_periods && !response.settled && !response.stalled; ++period) {
        solvers::History now;
        if (!run(stride * compared, now)) return response;
        response.changes.push_back(change(before, now, options.compared, static_cast<std::size_t>(stride)));
        response.settled = response.changes.back() <= options.settled;
        response.stalled = has_stalled(response.changes);
        if (options.progress) options.progress(period, response.changes.back());
        before = std::move(now);
    }
    response.complete = run(options.samples, response.last);
    return response;
}

}  // namespace cardan::platform
