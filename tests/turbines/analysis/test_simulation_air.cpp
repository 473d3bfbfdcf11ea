// The air of a run in time: its models, and a start that is the steady state of all of them.
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "turbines/analysis/simulation.hpp"
#include "turbines/machine/read_machine.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace cardan::testing::simulation_air_tests {

namespace {

using namespace turbines;

const Machine& nrel5mw() {
    static const Machine machine = read_machine("nrel5mw");
    return machine;
}

// Tilted, with gravity: periodic. The generator turns at the speed of the start.
SimulationSettings in_steady_wind(std::optional<Wake> wake, std::optional<Airfoils> airfoils) {
    return {.rotor_speed = 12.1 * units::rpm,
            .wind = 14,
            .air = {.wake = wake, .airfoils = airfoils},
            .controller = Controller::none(),
            .machine = {.pitch = 8.7 * units::degree,
                        .generator = GeneratorDof::locked,
                        .blade_elements = 3,
                        .tower_elements = 2},
            .tolerance = 1e-7};
}

std::string air_of(const Simulation& run) {
    for (const Remark& remark : run.remarks())
        if (remark.text.starts_with("air of the run: ")) return remark.text.substr(16);
    return "";
}

constexpr double revolution = 60 / 12.1;  // s

}  // namespace

// Reference: itself a revolution before. What is not at rest at the start decays within the first seconds.
TEST_CASE("air of a run: in steady wind it begins in its periodic state, all states of the air in it", "[invariant]") {
    for (const Wake wake : {Wake::none, Wake::frozen, Wake::equilibrium, Wake::oye}) {
        const Airfoils airfoils = wake == Wake::frozen ? Airfoils::steady : Airfoils::unsteady;
        CAPTURE(name_of(wake));
        Simulation run(nrel5mw(), in_steady_wind(wake, airfoils));
        const Recording recorded = run.record({.duration = 2 * revolution, .step = revolution / 16});
        REQUIRE(recorded.complete);
        for (const char* channel : {"RootMyc1", "RootMxc2", "TwrBsMyt", "RtAeroFxh", "RtAeroPwr"}) {
            const std::vector<double>& values = recorded.history[channel];
            const auto [low, high] = std::ranges::minmax(values);
            const double scale = std::max(std::abs(low), std::abs(high));
            CAPTURE(channel, scale);
            for (std::size_t i = 0; i <= 16; ++i) CHECK(std::abs(values[i + 16] - values[i]) < 1e-4 * scale);
        }
    }
}

TEST_CASE("air of a run: the model's own choice is taken, an option's before it, and both are said", "[property]") {
    Machine machine = nrel5mw();
    CHECK(air_of(Simulation(machine, in_steady_wind({}, {}))) == "wake oye, airfoils unsteady");
    machine.air->model = {.wake = Wake::equilibrium,
                          .airfoils = Airfoils::steady,
                          .wake_source = "DBEMT_Mod = 0 in a.dat",
                          .airfoils_source = "UA_Mod = 0 in a.dat"};
    CHECK(air_of(Simulation(machine, in_steady_wind({}, {}))) ==
          "wake equilibrium (DBEMT_Mod = 0 in a.dat), airfoils steady (UA_Mod = 0 in a.dat)");
    CHECK(air_of(Simulation(machine, in_steady_wind(Wake::oye, {}))) ==
          "wake oye, airfoils steady (UA_Mod = 0 in a.dat)");
    machine.air->model = {.inflow_time_constant = 4};
    CHECK(air_of(Simulation(machine, in_steady_wind({}, Airfoils::steady))) == "wake oye of 4 s, airfoils steady");
    machine.air->unsteady_airfoils.clear();
    CHECK(air_of(Simulation(machine, in_steady_wind({}, {}))) == "wake oye of 4 s, airfoils steady");
}

// At rest the air's states are found as well, with the wind from any side.
TEST_CASE("air of a run: a parked machine begins at rest, whatever the direction of the wind", "[invariant]") {
    for (const double degrees : {0.0, 90.0, 180.0, -60.0}) {
        CAPTURE(degrees);
        SimulationSettings settings = in_steady_wind({}, {});
        settings.rotor_speed = 0;
        settings.machine.pitch = 90 * units::degree;
        settings.air.propagation_direction = degrees * units::degree;
        Simulation run(nrel5mw(), settings);
        const Recording recorded = run.record({.duration = 2, .step = 0.25});
        REQUIRE(recorded.complete);
        for (const char* channel : {"RootMyc1", "RootMxc1", "TwrBsMyt", "TwrBsMxt"}) {
            const std::vector<double>& values = recorded.history[channel];
            CAPTURE(channel);
            for (const double value : values) CHECK(std::abs(value - values[0]) < 1e-4 * std::abs(values[0]) + 10);
        }
    }
}

}  // namespace cardan::testing::simulation_air_tests
