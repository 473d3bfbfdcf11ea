// A machine in time by a few lines: what is refused and how, what it says, how a run goes on.
//
// Reference: the same run in one piece, or given otherwise; equal means bit for bit. That it is the motion which other
// calls compute: tests/regression/test_simulate.cpp, and the same of the command: test_library_and_command.cpp.
#include "mbs/base/units.hpp"
#include "solvers/hdf5/history.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/refusal.hpp"
#include "turbines/analysis/in_unit.hpp"
#include "turbines/analysis/linear_model.hpp"
#include "turbines/analysis/simulation.hpp"
#include "turbines/machine/read_machine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardan::testing::simulation_tests {

namespace {

using namespace turbines;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

const Machine& nrel5mw() {
    static const Machine machine = read_machine("nrel5mw-fast");
    return machine;
}

MachineSettings coarse() {
    return {.blade_elements = 1, .tower_elements = 1};
}

SimulationSettings in_the_wind() {
    return {.wind = 12, .controller = Controller::baseline(), .machine = coarse(), .tolerance = 1e-5};
}

void check_equal(const solvers::History& a, const solvers::History& b) {
    CHECK(a.time == b.time);
    REQUIRE(a.values.size() == b.values.size());
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        CAPTURE(a.channels[i].name);
        CHECK(a.values[i] == b.values[i]);
    }
}

bool has(const std::vector<Remark>& remarks, Remark::Kind kind, const std::string& part) {
    return std::ranges::any_of(
        remarks, [&](const Remark& one) { return one.kind == kind && one.text.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("simulation: in memory and in a file a run is the same, and so it is in two pieces", "[property]") {
    const test::Folder folder;
    const std::string file = folder / "run.h5";
    const Recording whole = Simulation(nrel5mw(), in_the_wind()).record({.duration = 0.4, .step = 0.05});
    CHECK(whole.complete);
    CHECK(whole.history.time.size() == 9);
    static_cast<void>(Simulation(nrel5mw(), in_the_wind()).record(file, {.duration = 0.2, .step = 0.05}));
    const Recording rest =
        Simulation(nrel5mw(), in_the_wind()).record(file, {.duration = 0.4, .step = 0.05, .resume = true});
    check_equal(rest.history, whole.history);
    check_equal(solvers::read_history(file), whole.history);
    SimulationSettings other = in_the_wind();
    other.controller.period = 0.02;
    Simulation another(nrel5mw(), other);
    check_refused([&] { static_cast<void>(another.record(file, {.duration = 0.5, .step = 0.05, .resume = true})); },
                  {"RecordSettings::resume: run of ", "every 0.0125 s", "that of this run: every 0.02 s"});
}

TEST_CASE("simulation: a run that was broken off before its first rows begins", "[property]") {
    const test::Folder folder;
    const std::string whole = folder / "whole.h5", empty = folder / "empty.h5";
    Simulation first(nrel5mw(), in_the_wind());
    const Recording wanted = first.record(whole, {.duration = 0.2, .step = 0.05});
    {
        const auto writer =
            solvers::HistoryWriter::create(empty, first.channels(), solvers::read_history_info(whole).about);
        CHECK(writer.rows() == 0);
    }
    const Recording found =
        Simulation(nrel5mw(), in_the_wind()).record(empty, {.duration = 0.2, .step = 0.05, .resume = true});
    check_equal(found.history, wanted.history);
    check_equal(solvers::read_history(empty), wanted.history);
    const std::string none = folder / "none.h5";
    Simulation begins(nrel5mw(), in_the_wind());
    check_equal(begins.record(none, {.duration = 0.2, .step = 0.05, .resume = true}).history, wanted.history);
    CHECK(has(begins.remarks(), Remark::Kind::taken, "none.h5 is not there, the run begins"));
}

TEST_CASE("simulation: of a long run few channels are read again, the file has them all", "[property]") {
    const test::Folder folder;
    const std::string file = folder / "run.h5";
    const std::vector<std::string> kept{"TTDspFA", "RotSpeed", "rotor speed"};  // two: one by name and alias
    const Recording first =
        Simulation(nrel5mw(), in_the_wind()).record(file, {.duration = 0.2, .step = 0.05, .kept = kept});
    REQUIRE(first.history.channels.size() == 2);
    const Recording both = Simulation(nrel5mw(), in_the_wind())
                               .record(file, {.duration = 0.4, .step = 0.05, .resume = true, .kept = kept});
    const solvers::History all = solvers::read_history(file);
    CHECK(all.channels.size() > 100);
    CHECK(both.history.time == all.time);
    for (const char* channel : {"TTDspFA", "RotSpeed"}) CHECK(both.history[channel] == all[channel]);
    Simulation other(nrel5mw(), in_the_wind());
    check_refused([&] { static_cast<void>(other.record({.duration = 0.1, .kept = {"RotSpeeds"}})); }, {"RotSpeeds"});
}

TEST_CASE("simulation: a wind with all that it has is the speed that it has", "[property]") {
    SimulationSettings options = in_the_wind();
    Simulation by_speed(nrel5mw(), options);
    const double height = hub_at_rest(by_speed.turbine()).z();
    options.wind = Wind(SteadyWind{.speed = 12, .reference_height = height});
    Simulation by_wind(nrel5mw(), options);
    check_equal(by_speed.record({.duration = 0.1, .step = 0.05}).history,
                by_wind.record({.duration = 0.1, .step = 0.05}).history);
}

TEST_CASE("simulation: what was not given is told and filled in", "[property]") {
    std::vector<Remark> told;
    SimulationSettings options = in_the_wind();
    options.report = [&](const Remark& remark) { told.push_back(remark); };
    const Simulation run(nrel5mw(), options);
    CHECK(run.settings().rotor_speed == Approx(12.1 * units::rpm));
    CHECK(*run.settings().machine.pitch * units::to_degrees == Approx(3.83).margin(0.3));  // the report's at 12 m/s
    CHECK(run.settings().machine.blade_elements == 1);
    CHECK(run.settings().controller.individual_pitch == false);
    CHECK(has(told, Remark::Kind::taken, "start: 12.1 rpm, pitch "));
    CHECK(has(told, Remark::Kind::taken, "air of the run: wake oye, airfoils unsteady"));
    CHECK(has(told, Remark::Kind::taken, "controller: pitch prescribed"));
    CHECK(run.remarks().size() == told.size());
    CHECK(run.title() == nrel5mw().description.name);
    CHECK(run.channels().size() > 100);
}

// The generator holds what the rotor's torque gives: without wind, at the start.
TEST_CASE("simulation: a constant torque of the rotor less that of the generator accelerates the rotor", "[analytic]") {
    SimulationSettings options{.generator_torque = 1e4,
                               .rotor_torque = RotorTorque::constant(2e6),
                               .machine = {.tower = TowerDof::rigid, .blades = BladeDof::rigid},
                               .gravity = false};
    Simulation run(nrel5mw(), options);
    const solvers::History history = run.record({.duration = 1, .step = 0.1}).history;
    const double ratio = nrel5mw().description.drive_train.gear_ratio, start = 12.1 * units::rpm;
    const std::vector<double>& speed = history["RotSpeed"];
    const std::vector<double>& energy = history["kinetic energy"];
    CHECK(speed.front() == Approx(start));
    // dE = integral of (T_rotor - ratio T_generator) omega: the mean of all that turns.
    double work = 0;
    for (std::size_t i = 0; i + 1 < speed.size(); ++i)
        work += (2e6 * (speed[i] + speed[i + 1]) / 2 - 1e4 * ratio * (speed[i] + speed[i + 1]) / 2) * 0.1;
    CHECK(energy.back() - energy.front() == Approx(work).epsilon(1e-2));
}

TEST_CASE("simulation: errors name the field, its value and what is allowed", "[property]") {
    const auto refused = [](const SimulationSettings& options, std::initializer_list<std::string> parts) {
        check_refused([&] { Simulation(nrel5mw(), options); }, parts);
    };
    refused({.rotor_speed = not_a_number}, {"SimulationSettings::rotor_speed", "nan", "finite"});
    refused({.tolerance = 0}, {"SimulationSettings::tolerance", "= 0", "> 0"});
    refused({.azimuth = not_a_number}, {"SimulationSettings::azimuth", "nan"});
    refused({.controller = Controller::baseline(), .generator_slope = 20},
            {"SimulationSettings::generator_slope", "20", "none beside SimulationSettings::controller"});
    refused({.controller = Controller::baseline(), .machine = {.generator = GeneratorDof::locked}},
            {"SimulationSettings::controller: rotor = driven", "MachineSettings::generator = GeneratorDof::free"});
    refused({.controller = {.kind = Controller::Kind::baseline, .period = 0}}, {"Controller::period", "= 0"});
    refused({.controller = {.kind = Controller::Kind::baseline, .generator_efficiency = 94.4}},
            {"Controller::generator_efficiency", "94.4", "0 ... 1"});
    refused({.controller = {.kind = Controller::Kind::baseline, .input = "x"}}, {"Controller::input", "x", "library"});
    refused({.controller = {.kind = Controller::Kind::library}}, {"Controller::library", "none", "DISCON"});
    refused({.controller = {.kind = Controller::Kind::baseline, .individual_pitch = true}},
            {"Controller::individual_pitch", "collective"});
    refused({.machine = coarse(), .q = {{"jaw", 1.0}}}, {"unknown coordinate 'jaw'"});
    refused({.machine = coarse(), .qd = {{"generator", not_a_number}}, .start = SimulationStart::undeformed},
            {"SimulationSettings::qd: generator = nan"});
    check_refused([&] { Simulation(read_machine("wt600"), {.wind = 9}); }, {"air = none: ", "airfoils"});
    check_refused([&] { Simulation(read_machine("wt600"), {.controller = Controller::baseline()}); },
                  {"air = none: ", "airfoils"});
    Simulation run(nrel5mw(), {.machine = coarse(), .start = SimulationStart::undeformed});
    check_refused([&] { static_cast<void>(run.record({.duration = 0})); }, {"RecordSettings::duration", "= 0"});
    check_refused([&] { static_cast<void>(run.record({.step = -1})); }, {"RecordSettings::step", "= -1"});
    check_refused([&] { static_cast<void>(run.record({.resume = true})); }, {"RecordSettings::resume", "file"});
}

TEST_CASE("simulation: a run that is cancelled keeps what it has", "[property]") {
    SimulationSettings options{.machine = coarse(), .start = SimulationStart::undeformed};
    int steps = 0;
    options.cancelled = [&] { return ++steps > 20; };
    const Recording part = Simulation(nrel5mw(), options).record({.duration = 50, .step = 0.01});
    CHECK_FALSE(part.complete);
    CHECK(!part.history.time.empty());
    CHECK(part.history.time.back() < 50);
}

TEST_CASE("simulation: the search for its start, and for a state to linearise about, can be cancelled", "[property]") {
    SimulationSettings options{.machine = coarse()};
    int asked = 0;
    options.cancelled = [&] { return ++asked > 10; };
    CHECK_THROWS_WITH(Simulation(nrel5mw(), options), Catch::Contains("it was cancelled"));
    CHECK(asked < 20);
    asked = 0;
    LinearModelSettings about{.machine = coarse(), .gravity = true};
    about.cancelled = options.cancelled;
    CHECK_THROWS_WITH(linear_model(nrel5mw(), about), Catch::Contains("it was cancelled"));
    CHECK(asked < 20);
}

// What is printed for people must give back the same value.
TEST_CASE("in_unit: a number of few digits, times the unit, is the value", "[property]") {
    for (const double unit : {units::rpm, units::degree})
        for (int i = -300; i < 300; ++i) {
            const double number = i / 100.0, value = number * unit;
            CHECK(in_unit(value, unit) == number);
            CHECK(representable(value, unit) == value);
            const double any = representable(std::sin(1.0 + i), unit);
            CHECK(in_unit(any, unit) * unit == any);
            CHECK(any == Approx(std::sin(1.0 + i)).epsilon(1e-15));
        }
}

}  // namespace cardan::testing::simulation_tests
