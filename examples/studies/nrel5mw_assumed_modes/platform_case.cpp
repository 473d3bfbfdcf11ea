#include "examples/studies/nrel5mw_assumed_modes/platform_case.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/machines/nrel5mw_platform.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardan::paper2018 {

namespace {

constexpr double rated_speed = 12.1 * units::rpm;
constexpr int samples = 720;

HubMotion root_motion(const PlatformCase& of, double time) {
    const double w = rated_speed / of.revolutions, s = std::sin(w * time), c = std::cos(w * time);
    turbines::Nrel5mwMotion motion;
    motion.azimuth = {rated_speed * time, rated_speed, 0};
    motion.pitch = {of.pitch * s, of.pitch * w * c, -of.pitch * w * w * s};
    motion.heave = {of.heave_rate * time, of.heave_rate, 0};
    const HubMotion root = turbines::nrel5mw_blade_root(motion);
    return of.derivatives ? root : root.without_derivatives();
}

// Amplitudes of the samples, which are harmonics only but for products of them in the root load.
void analyse(Signal& y, int harmonics) {
    const auto n = static_cast<std::size_t>(samples);
    const auto [low, high] = std::minmax_element(y.samples.begin(), y.samples.end());
    y.min = *low, y.max = *high;
    for (int k = 0; k <= harmonics; ++k) {
        Complex sum = 0;
        for (std::size_t i = 0; i < n; ++i)
            sum += y.samples[i] * std::polar(2.0 / samples, -2 * pi * k * static_cast<double>(i) / samples);
        if (k == 0) {
            y.mean = sum.real() / 2;
        } else {
            y.amplitude.push_back(std::abs(sum));
            y.phase.push_back(std::arg(sum));
        }
    }
}

}  // namespace

AssumedModesBlade in_natural_modes(const AssumedModesBlade& blade, int count) {
    const auto all_modes = natural_modes(blade.at(turbines::nrel5mw_spinning_hub(rated_speed)));
    Matrix columns(blade.size(), std::min<Eigen::Index>(count, blade.size()));
    for (Eigen::Index k = 0; k < columns.cols(); ++k) columns.col(k) = entry(all_modes, k).shape;
    return blade.reduced(columns);
}

PlatformResponse platform_response(const AssumedModesBlade& blade, const PlatformCase& of) {
    const double period = of.revolutions * 2 * pi / rated_speed;
    const auto system =
        solvers::PeriodicSystem::second_order(period, blade.size(), [&](double time, solvers::SecondOrderSystem& out) {
            const AssumedModesMatrices m = blade.at(root_motion(of, time));
            out.M = m.M, out.C = m.G + turbines::nrel5mw_platform_damping * m.K_elastic, out.K = m.K;
        });
    const auto load = [&](double time) { return blade.at(root_motion(of, time)).f; };
    const solvers::ForcedResponse found = solvers::forced_response(system, load, of.harmonics);

    PlatformResponse response;
    response.remainder = found.remainder;
    const Matrix tip = blade.shapes(blade.length());
    for (int i = 0; i <= samples; ++i) {
        const double time = period * i / samples;
        const Vector q = found.at(time);
        const Vector at_tip = tip * q;
        const RootLoad root = blade.root_load(root_motion(of, time), q, found.at(time, 1), found.at(time, 2));
        const std::array<double, signals> values{at_tip(2), at_tip(1), root.moment.y(), root.moment.z()};
        response.time.push_back(time);
        for (std::size_t s = 0; s < signals; ++s) response.by_signal.at(s).samples.push_back(values.at(s));
    }
    for (Signal& signal : response.by_signal) analyse(signal, of.harmonics);
    return response;
}

namespace {
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
}

const Reference& reference_at_rest() {
    static const Reference reference{
        {{"tip flap w, m", 1, 0.4004, 0.4892, 0.3101, {{1, 0.08952, -112.9}, {2, 0.00158, unknown}}},
         {"tip edge v, m", 1, 0.05080, 0.4951, -0.3934, {{1, 0.4443, -91.21}, {2, 0.00190, unknown}}},
         {"root My, kN m", 1e3, 1084, 1217, 950.6, {{1, 133.2, 179.9}}},
         {"root Mz, kN m", 1e3, -5.71, 3614, -3626, {{1, 3620, 89.56}}}}};
    return reference;
}

const Reference& reference_pitching() {
    static const Reference reference{
        {{"tip flap w, m",
          1,
          0.3985,
          1.309,
          -0.5369,
          {{1, 0.6380, 89.69}, {2, 0.08881, -114.3}, {3, 0.4941, 89.85}, {5, 0.0112, unknown}}},
         {"tip edge v, m",
          1,
          0.05100,
          0.5349,
          -0.4676,
          {{1, 0.05079, 74.65}, {2, 0.4369, -91.22}, {3, 0.04199, 106.1}}},
         {"root My, kN m", 1e3, 1078, 3348, -1257, {{1, 1987, 89.93}, {2, 138.1, 179.9}, {3, 1180, 89.76}}},
         {"root Mz, kN m", 1e3, -5.89, 3721, -3714, {{1, 107.7, -179.8}, {2, 3559, 89.56}, {3, 100.9, -9.3}}}}};
    return reference;
}

}  // namespace cardan::paper2018
