#include "examples/studies/machines/nrel5mw_platform_reference.hpp"

#include "mbs/base/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardan::platform {

Harmonics harmonics(const std::vector<double>& samples, int count) {
    const std::size_t n = samples.size() - 1;
    const auto mean_with = [&](auto&& weight) {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) sum += samples[i] * weight(2 * pi * static_cast<double>(i));
        return sum / static_cast<double>(n);
    };
    const auto [min, max] = std::ranges::minmax(samples);
    Harmonics h{mean_with([](double) { return 1.0; }), max, min, {}, {}};
    for (int k = 1; k <= count; ++k) {
        const double turn = k / static_cast<double>(n);
        const double c = 2 * mean_with([&](double angle) { return std::cos(angle * turn); });
        const double s = 2 * mean_with([&](double angle) { return std::sin(angle * turn); });
        h.amplitude.push_back(std::hypot(c, s));
        h.phase.push_back(std::atan2(-s, c));
    }
    return h;
}

double ReferenceSignal::largest_amplitude() const {
    return std::ranges::max(harmonics, {}, &ReferenceHarmonic::amplitude).amplitude;
}

const ReferenceHarmonic* ReferenceSignal::harmonic(int k) const {
    const auto known = std::ranges::find(harmonics, k, &ReferenceHarmonic::k);
    return known == harmonics.end() ? nullptr : &*known;
}

// Converged by a method that shares nothing with the joint chain; good to 0.05 % or 5e-5 m.
const std::array<ReferenceCase, 2>& reference_cases() {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    static const std::array<ReferenceCase, 2> cases{
        {{"none",
          {{{0.4004, 0.4892, 0.3101, {{1, 0.08952, -112.9}, {2, 0.00158, unknown}}},
            {0.05080, 0.4951, -0.3934, {{1, 0.4443, -91.21}, {2, 0.00190, unknown}}},
            {1084, 1217, 950.6, {{1, 133.2, 179.9}}},
            {-5.71, 3614, -3626, {{1, 3620, 89.56}}}}}},
         {"pitch",
          {{{0.3985,
             1.309,
             -0.5369,
             {{1, 0.6380, 89.69}, {2, 0.08881, -114.3}, {3, 0.4941, 89.85}, {5, 0.0112, unknown}}},
            {0.05100, 0.5349, -0.4676, {{1, 0.05079, 74.65}, {2, 0.4369, -91.22}, {3, 0.04199, 106.1}}},
            {1078, 3348, -1257, {{1, 1987, 89.93}, {2, 138.1, 179.9}, {3, 1180, 89.76}}},
            {-5.89, 3721, -3714, {{1, 107.7, -179.8}, {2, 3559, 89.56}, {3, 100.9, -9.3}}}}}}}};
    return cases;
}

}  // namespace cardan::platform
