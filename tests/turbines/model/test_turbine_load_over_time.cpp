// Loads over time on a turbine: thrust by hand, the same loads held constant, a slow ramp in time.
#include "elements/machine_elements/load_over_time.hpp"
#include "mbs/base/units.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/sampled_channels.hpp"
#include "turbines/model/station_channels.hpp"
#include "turbines/reference_turbines/wt600.hpp"

#include <algorithm>

namespace cardan::testing::turbine_load_over_time {

using namespace turbines;

namespace {

constexpr double tilt = 5 * units::degree, tower_height = 50.7, shaft_height = 52.2;

Sampled sampled(const Turbine& turbine, const MachineState& state) {
    std::vector<ChannelGroup> groups = channels(turbine);
    const Stations stations{.blades = {0, 4.7, 20. / 3, 11, 17}, .tower = {0, 15, 34}};
    for (ChannelGroup& group : station_channels(turbine, stations)) groups.push_back(std::move(group));
    return {turbine.system(), groups, state};
}

Turbine with(const Turbine& bare, FrameLoad load) {
    ForceSet forces = bare.forces();
    forces.add_wrench(std::move(load));
    return bare.with_forces(forces);
}

}  // namespace

TEST_CASE("turbine: a table of thrust along the shaft comes down to the tower's foot with its height", "[analytic]") {
    const Turbine bare = wt600(wt600_paper_assembly());
    const std::vector<double> times{0, 2, 5};
    const std::vector<Vec3> thrust{Vec3(0, 0, 0), Vec3(8e4, 0, 0), Vec3(3e4, 0, 0)};  // x of the shaft: downwind
    const Turbine turbine =
        with(bare, force_over_time("thrust", bare.layout().shaft, times, thrust, WrenchAxes::frame));
    MachineState state(turbine);
    for (const auto& [time, T] :
         {std::pair{-1.0, 0.0}, {1.0, 4e4}, {2.0, 8e4}, {3.5, 5.5e4}, {5.0, 3e4}, {99.0, 3e4}}) {
        state.time = time;
        const Sampled now = sampled(turbine, state);
        CAPTURE(time);
        CHECK(now["TwrBsMyt"] == Approx(T * std::cos(tilt) * shaft_height).margin(1e-6));
        CHECK(now["TwrBsFxt"] == Approx(T * std::cos(tilt)).margin(1e-8));
        CHECK(now["YawBrMyp"] == Approx(T * std::cos(tilt) * (shaft_height - tower_height)).margin(1e-6));
        CHECK(now["TwHt2MLyt"] == Approx(T * std::cos(tilt) * (shaft_height - 15)).margin(1e-6));
        CHECK(now["TwHt3FLzt"] == Approx(-T * std::sin(tilt)).margin(1e-8));
        CHECK(now["RootMyb1"] == Approx(0).margin(1e-6));
    }
}

TEST_CASE("turbine: a load over time counts in all channels as the same load that is constant, at each time",
          "[property]") {
    const Turbine bare = wt600(wt600_paper_assembly());
    const std::vector<double> times{0, 2, 6};
    const std::vector<Wrench> rows{
        {Vec3(0, 0, 0), Vec3(0, 0, 0)}, {Vec3(8e4, 2e3, 0), Vec3(3e4, 0, 1e3)}, {Vec3(2e4, 0, -4e3), Vec3(0, 5e3, 0)}};
    const CardanBeam& blade = bare.layout().blades[0];
    const std::vector<FrameId> frames{bare.layout().shaft, blade.nodes[2], blade.elements[1].segments[2].carrier};
    MachineState state = in_motion(bare, 5);
    for (const WrenchAxes axes : {WrenchAxes::base, WrenchAxes::frame})
        for (const FrameId frame : frames)
            for (double time : {-1.0, 0.5, 2.0, 5.0, 9.0}) {
                const double t = std::clamp(time, 0.0, 6.0), u = t < 2 ? t / 2 : (t - 2) / 4;
                const Wrench &a = rows[t < 2 ? 0 : 1], &b = rows[t < 2 ? 1 : 2];
                const Wrench constant{(1 - u) * a.force + u * b.force, (1 - u) * a.moment + u * b.moment};
                state.time = time;
                const Sampled now = sampled(with(bare, load_over_time("gust", frame, times, rows, axes)), state),
                              expected = sampled(with(bare, {"now", frame, constant, axes}), state);
                CAPTURE(time, frame.index);
                for (const auto& [name, value] : expected.values) {
                    CAPTURE(name);
                    CHECK(now[name] == Approx(value).epsilon(1e-10).margin(1e-6));
                }
            }
}

TEST_CASE("turbine: under a slow ramp of thrust a recorded tower follows statics", "[analytic]") {
    const Turbine bare = isolated_tower(wt600_description(), wt600_paper_assembly(), true);
    const double T = 1e5, duration = 30;
    const Turbine turbine =
        with(bare, force_over_time("thrust", bare.layout().tower_top, {0, duration}, {Vec3(0, 0, 0), Vec3(T, 0, 0)}));
    const Vector zero = Vector::Zero(turbine.system().model.size());
    solvers::Integrator integrator(turbine.system(), {}, 0, zero, zero);
    solvers::Recorder recorder(integrator, station_channels(turbine, {.tower = {0, 25.35}}));
    solvers::History history;
    solvers::require_result(record(integrator, recorder, solvers::sample_times(0, 40, 0.5), history));
    // About statics a mass on a spring oscillates by T / (omega duration); the period of the tower is about 1.2 s.
    const std::vector<double> base = history["TwHt1MLyt"], middle = history["TwHt2MLyt"], force = history["TwHt1FLxt"];
    for (std::size_t i = 0; i < history.time.size(); ++i) {
        const double now = T * std::min(1.0, history.time[i] / duration);
        CHECK(std::abs(base[i] - now * tower_height) < 0.02 * T * tower_height);
        CHECK(std::abs(middle[i] - now * tower_height / 2) < 0.02 * T * tower_height);
        CHECK(std::abs(force[i] - now) < 0.02 * T);
    }
    CHECK(integrator.statistics().restarts == 0);  // a kink is where a step ends, no more
}

}  // namespace cardan::testing::turbine_load_over_time
