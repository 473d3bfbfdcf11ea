#include "examples/studies/nrel5mw_assumed_modes/platform_case.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "turbines/reference_turbines/nrel5mw_platform.hpp"

#include <algorithm>
#include <cmath>

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
    const Matrix tip = blade.shapes(blade.length());
    for (int i = 0; i <= samples; ++i) {
        const double time = period * i / samples;
        const Vector q = found.at(time);
        const Vector at_tip = tip * q;
        const RootLoad root = blade.root_load(root_motion(of, time), q, found.at(time, 1), found.at(time, 2));
        const std::array<double, platform::signals> values{at_tip(2), at_tip(1), root.moment.y(), root.moment.z()};
        response.time.push_back(time);
        for (std::size_t s = 0; s < platform::signals; ++s) response.by_signal.at(s).samples.push_back(values.at(s));
    }
    // Harmonics but for products of them in the root load.
    for (Signal& signal : response.by_signal)
        static_cast<platform::Harmonics&>(signal) = platform::harmonics(signal.samples, of.harmonics);
    return response;
}

}  // namespace cardan::paper2018
