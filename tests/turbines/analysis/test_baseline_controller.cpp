// Numbers of the usual controller for any machine.
//
// Reference: the gains that the report of the NREL 5 MW machine states for it, from its own linearisations
// [J. Jonkman, S. Butterfield, W. Musial, G. Scott 2009, NREL/TP-500-38060, section 7]; the same machine in other
// units.
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "turbines/analysis/baseline_controller.hpp"
#include "turbines/analysis/simulation.hpp"
#include "turbines/machine/read_machine.hpp"
#include "turbines/reference_turbines/nrel5mw_controller.hpp"

#include <cmath>

namespace cardan::testing::baseline_controller_tests {

namespace {

using namespace turbines;

// The NREL 5 MW machine with a gearbox by which it is not recognised.
Machine another_machine(double gear_ratio) {
    Machine machine = read_machine("nrel5mw");
    DriveTrainDescription& train = machine.description.drive_train;
    train.generator_inertia *= std::pow(train.gear_ratio / gear_ratio, 2);
    train.gear_ratio = gear_ratio;
    return machine;
}

double of_report(double at_zero, double pitch) {
    return at_zero / (1 + pitch / nrel5mw_controller().doubling_pitch);
}

}  // namespace

TEST_CASE("baseline controller: the machine's own gains are near those of its report", "[reference]") {
    const VariableSpeedParameters own = baseline_controller(another_machine(96.5)), report = nrel5mw_controller();
    REQUIRE(own.gains.size() >= 5);
    for (const PitchGains& one : own.gains) {
        CAPTURE(one.pitch * units::to_degrees);
        // The report fits a line to the slopes of the power.
        CHECK(one.proportional == Approx(of_report(report.proportional, one.pitch)).epsilon(0.25));
        CHECK(one.integral == Approx(of_report(report.integral, one.pitch)).epsilon(0.25));
    }
    CHECK(own.optimal_gain == Approx(report.optimal_gain).epsilon(0.05));
    CHECK(own.rated_power == Approx(report.rated_power).epsilon(1e-3));
    CHECK(own.corner_frequency == Approx(report.corner_frequency).epsilon(1e-3));
    CHECK(own.max_torque == Approx(report.max_torque).epsilon(0.01));
    CHECK(own.max_pitch_rate == Approx(report.max_pitch_rate).epsilon(1e-3));
}

TEST_CASE("baseline controller: on another shaft it is the same controller of the rotor", "[property]") {
    const VariableSpeedParameters slow = baseline_controller(another_machine(1)),
                                  fast = baseline_controller(another_machine(50));
    REQUIRE(slow.gains.size() == fast.gains.size());
    for (std::size_t i = 0; i < slow.gains.size(); ++i) {
        CHECK(fast.gains[i].pitch == Approx(slow.gains[i].pitch));
        CHECK(50 * fast.gains[i].proportional == Approx(slow.gains[i].proportional).epsilon(1e-9));
        CHECK(50 * fast.gains[i].integral == Approx(slow.gains[i].integral).epsilon(1e-9));
    }
    CHECK(fast.optimal_gain * 50 * 50 * 50 == Approx(slow.optimal_gain).epsilon(1e-9));
    CHECK(fast.region_1_5_speed == Approx(50 * slow.region_1_5_speed));
    CHECK(fast.max_torque * 50 == Approx(slow.max_torque));
}

TEST_CASE("baseline controller: a model's gains go before the machine's own, the report's before both", "[property]") {
    Machine machine = another_machine(96.5);
    machine.controller.gains = {.corner_frequency = 1.2,
                                .min_speed = 60,
                                .rated_speed = 121,
                                .optimal_gain = 2,
                                .rated_torque = 40000,
                                .max_torque = 45000,
                                .max_torque_rate = 16000,
                                .constant_power = false,
                                .pitch_gains = {{0.05, 0.01, 0.002}, {0.3, -0.001, 0.001}},
                                .max_pitch = 1.5,
                                .max_pitch_rate = 0.1,
                                .source = "DISCON.IN"};
    std::vector<Remark> remarks;
    const VariableSpeedParameters p = baseline_controller(machine, kept(remarks, {}));
    CHECK(p.corner_frequency == 1.2);
    CHECK(p.reference_speed == 121);
    CHECK(p.rated_power == 40000 * 121.0);
    CHECK(p.optimal_gain == 2);
    CHECK(p.max_torque == 45000);
    CHECK(p.max_torque_rate == 16000);
    CHECK_FALSE(p.constant_power);
    REQUIRE(p.gains.size() == 2);
    CHECK(p.gains[1].proportional == -0.001);
    CHECK(p.max_pitch == 1.5);
    CHECK(p.max_pitch_rate == 0.1);
    REQUIRE(remarks.size() == 1);
    CHECK(remarks[0].text == "controller: baseline, gains of DISCON.IN");

    Machine reported = read_machine("nrel5mw-fast");
    reported.controller.gains = machine.controller.gains;
    CHECK(baseline_controller(reported).proportional == nrel5mw_controller().proportional);
}

TEST_CASE("baseline controller: what it needs and the machine does not say is refused", "[property]") {
    Machine machine = another_machine(90);
    machine.operation.rated_power = 0;
    check_refused([&] { static_cast<void>(baseline_controller(machine)); }, {"Controller::baseline()", "rated_power"});
    machine = another_machine(90);
    machine.operation.rotor_speed = 0;
    check_refused([&] { static_cast<void>(baseline_controller(machine)); }, {"Controller::baseline()", "rated speed"});
    machine = another_machine(90);
    machine.air.reset();
    check_refused([&] { static_cast<void>(baseline_controller(machine)); }, {"air", "airfoils"});
}

// From the pitch with which the rigid machine holds rated power, within a few seconds to a steady state that holds it.
TEST_CASE("baseline controller: it holds rated speed and power in a steady wind", "[property]") {
    const Machine machine = another_machine(80);
    Simulation run(machine, {.wind = 16,
                             .controller = Controller::baseline(),
                             .machine = {.tower = TowerDof::rigid, .blades = BladeDof::rigid},
                             .tolerance = 1e-5,
                             .gravity = false});
    const solvers::History history = run.record({.duration = 40, .step = 0.5}).history;
    const std::vector<double>&speed = history["RotSpeed"], &power = history["generator power"];
    for (std::size_t i = 0; i < speed.size(); ++i) {
        CHECK(speed[i] == Approx(12.1 * units::rpm).epsilon(0.05));
        if (history.time[i] > 30) CHECK(speed[i] == Approx(12.1 * units::rpm).epsilon(2e-3));
    }
    CHECK(power.back() == Approx(machine.operation.rated_power).epsilon(1e-3));
}

}  // namespace cardan::testing::baseline_controller_tests
