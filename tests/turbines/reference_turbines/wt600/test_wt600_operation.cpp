// The 600 kW machine in operation: its elements at the points that define them, and the machine they leave untouched.
#include "mbs/base/units.hpp"
#include "mbs/kernels/metric.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/linear/linearise.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/oracles/root_finding.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/refusal.hpp"
#include "turbines/reference_turbines/wt600_operation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace cardan;
using namespace cardan::testing;
using namespace cardan::turbines;

namespace {

using units::rpm;

}  // namespace

TEST_CASE("wt600 operation: at the grid the machine gives 600 kW at about 30.4 rpm of the rotor", "[analytic]") {
    const KlossCurve machine = wt600_kloss_curve();
    CHECK(machine.synchronous_speed == Approx(1500 * rpm).epsilon(1e-14));
    CHECK(machine.torque(1.06 * 1500 * rpm) == Approx(9000).epsilon(1e-13));
    const double speed =
        oracles::bisect([&](double w) { return machine.torque(w) * w - 600e3; }, 1500 * rpm, 1560 * rpm);
    // Kloss' formula solved for the slip with the torque at this speed.
    const double r = 9000 * speed / 600e3, slip = 0.06 * (r - std::sqrt(r * r - 1));
    CHECK(speed == Approx(1500 * rpm * (1 + slip)).epsilon(1e-10));
    CHECK(speed / 50 / rpm == Approx(30.4).margin(0.05));
}

TEST_CASE("wt600 operation: the converter's table holds the best tip speed ratio up to 600 kW at 32.9 rpm",
          "[analytic]") {
    const TorqueTable table = wt600_torque_table();
    // Table 1: 600 kW at 11.86 m/s with a tip speed ratio of 6.25 and a radius of 21.5 m.
    const double rho = 1.225, R = 21.5, l = 6.25, rated = l * 11.86 / R;
    CHECK(wt600_rated_speed() == Approx(3.448).margin(5e-4));
    CHECK(wt600_rated_speed() == Approx(rated).epsilon(1e-14));
    const double cp = 600e3 / (rho / 2 * pi * R * R * std::pow(11.86, 3));
    CHECK(cp == Approx(0.404).margin(5e-4));
    for (double n : {20.0, 22.0, 24.0, 26.0, 28.0, 30.0, 32.0}) {
        const double w = n * rpm, V = w * R / l, power = cp * rho / 2 * pi * R * R * V * V * V;
        CHECK(table.torque(50 * w) * 50 * w == Approx(power).epsilon(1e-12));
    }
    CHECK(table.torque(50 * rated) * 50 * rated == Approx(600e3).epsilon(1e-12));
    CHECK(table.torque(50 * rated) == Approx(3480.6).margin(0.05));
    CHECK(table.torque(50 * 35 * rpm) == Approx(600e3 / (50 * rated)).epsilon(1e-12));
    CHECK(table.torque(50 * 18 * rpm) == 0);
    // In the nominal wind the prescribed load drives the rotor to that speed.
    const RotorCurve curve = wt600_rotor_curve();
    const double speed = oracles::bisect(
        [&](double w) { return curve.torque(11.86, 0.0, w, 0.0) - 50 * table.torque(50 * w); }, 26 * rpm, 36 * rpm);
    CHECK(speed == Approx(rated).epsilon(1e-6));
}

TEST_CASE("wt600 operation: with the converter, rated operation is an equilibrium that the machine returns to",
          "[analytic]") {
    Wt600OperationOptions options{.assembly = wt600_paper_assembly(), .generator = Wt600Generator::converter};
    const Wt600Operation machine = wt600_operation(options);
    const System& system = machine.turbine.system();
    const int spin = machine.turbine.rotor().spin, n = system.model.size();
    Workspace workspace(system.model);
    // What the torques left over would do to all that turns with the rotor, rad/s^2.
    const auto drift = [&](double speed) {
        solvers::SteadyOptions steady;
        steady.rotor_speed = speed;
        const solvers::SteadyState state = solvers::steady_state(system, spin, steady);
        REQUIRE(state.converged);
        const Kinematics kin = kinematics(system.model, state.at.q, workspace);
        Vector Q(n);
        Matrix g(n, n);
        system.forces.generalised_forces({state.at, kin}, Q);
        metric(kin, g);
        return Q(spin) / g(spin, spin);
    };
    CHECK(std::abs(drift(wt600_rated_speed())) < 1e-5);  // 0.3 mrad/s in half a minute
    CHECK(drift(0.98 * wt600_rated_speed()) > 1e-3);
    CHECK(drift(1.02 * wt600_rated_speed()) < -1e-3);
}

TEST_CASE("wt600 operation: without grid, brake and wind it is the machine with pitch springs", "[property]") {
    Wt600OperationOptions options{.assembly = wt600_paper_assembly(), .at_grid = false, .wind = 0};
    const Wt600Operation machine = wt600_operation(options);
    const Turbine plain = wt600(wt600_paper_assembly());
    const Vector zero = Vector::Zero(plain.system().model.size());
    const DynamicState rest = at_rest(zero);
    const auto a = solvers::linearise(machine.turbine.system(), rest), b = solvers::linearise(plain.system(), rest);
    CHECK((a.elastic - b.elastic).norm() == Approx(0).margin(1e-12 * b.elastic.norm()));
    CHECK((a.damping - b.damping).norm() == Approx(0).margin(1e-12 * b.damping.norm()));
    CHECK((a.mass - b.mass).isZero(0));
    // On the brake and at the grid the generator's coordinate is damped, and nothing else.
    machine.brake_valve->turn(true, -10);
    machine.grid->turn(true, -10);
    const auto c = solvers::linearise(machine.turbine.system(), rest);
    Matrix more = c.damping - b.damping;
    const int spin = plain.rotor().spin;
    const double kloss = 2500 * wt600_kloss_curve().slope(0);
    CHECK(more(spin, spin) == Approx(2500 * 6e3 / 1 + kloss).epsilon(1e-9));
    more(spin, spin) = 0;
    CHECK(more.norm() < 1e-9 * b.damping.norm());
}

TEST_CASE(
    "wt600 operation: off the grid, in feather and on the brake it stands, and the recorded powers are the work of "
    "all loads",
    "[property]") {
    const Wt600Operation machine =
        wt600_operation({.assembly = wt600_paper_assembly(1), .generator = Wt600Generator::converter});
    const System& system = machine.turbine.system();
    const solvers::SteadyState start =
        solvers::steady_state(system, machine.turbine.rotor().spin, {.rotor_speed = wt600_rated_speed()});
    REQUIRE(start.converged);
    solvers::Integrator integrator(system, {}, 0, start.at.q, start.at.qd, {});
    solvers::Recorder recorder(integrator, machine.channels);
    solvers::History history;
    const double step = 0.01;
    const auto run = [&](double from, double to) {
        REQUIRE(solvers::record(integrator, recorder, solvers::sample_times(from, to, step), history).reached());
    };
    run(0, 1);
    machine.grid->turn(false, 1);
    integrator.restart();
    run(1 + step, 2);
    machine.pitch->move_to(pi / 2, 2);
    integrator.restart();
    run(2 + step, 14);
    machine.brake_valve->turn(true, 14);
    integrator.restart();
    run(14 + step, 18);
    const auto at = [&](double time) { return static_cast<std::size_t>(std::lround(time / step)); };
    const std::vector<double>& speed = history["RotSpeed"];
    CHECK(speed[at(1)] == Approx(speed[0]).epsilon(1e-5));  // rated operation is an equilibrium
    CHECK(speed[at(2)] > 1.03 * speed[0]);
    CHECK(std::abs(speed.back()) < 0.02 * speed[at(14)]);

    const double kinetic = std::ranges::max(history["kinetic energy"]);
    const auto work = [&](const std::string& channel) {
        const std::vector<double>& power = history[channel];
        double sum = 0;
        for (std::size_t i = 1; i < power.size(); ++i) sum += step * (power[i - 1] + power[i]) / 2;
        return sum / kinetic;
    };
    double recorded = work("rotor load power") - work("generator power") - work("brake power");
    for (int k = 1; k <= 3; ++k) recorded += work(text("blade ", k, " pitch drive power"));
    CHECK(work("brake power") > 0.05);
    // Of the work of the thrust, on the way of the tower's top, there is no channel.
    CHECK(integrator.energy().loads / kinetic == Approx(recorded).margin(5e-3));
    CHECK(std::abs(integrator.energy().error) < 1e-5 * kinetic);
}

TEST_CASE("wt600 operation: a command turns all blades toward feather, against their coordinates", "[property]") {
    const Wt600Operation machine = wt600_operation({.assembly = wt600_paper_assembly(), .pitch = 0.3});
    const Model& model = machine.turbine.system().model;
    Vector q = Vector::Zero(model.size());
    const Vector qd = q;
    for (BodyId pitch : machine.turbine.layout().pitch) q(model.index(pitch)) = -0.3;
    Workspace workspace(model);
    Vector Q(model.size());
    const auto force = [&](double t) {
        machine.turbine.system().forces.generalised_forces(
            {{.time = t, .q = q, .qd = qd}, kinematics(model, q, workspace)}, Q);
        return Q(model.index("blade 2 pitch"));
    };
    const double still = force(0);
    machine.pitch->move_to(1.0, 0);
    CHECK(force(0) == Approx(still).margin(1e-6));
    CHECK(force(3) < still - 0.1 * 5e7);
    CHECK(machine.pitch->at(2).rate == Approx(8 * units::degree));
    const RotorCurve::Value there = machine.rotor.value({{.q = q, .qd = qd}, kinematics(model, q, workspace)});
    CHECK(there.torque == Approx(machine.rotor.curve.torque(11.86, 0.0, 0.0, 0.3)).epsilon(1e-12));
}

TEST_CASE("wt600 operation: bad input is refused", "[property]") {
    check_refused([] { (void)wt600_operation({.wind = -1}); }, {"wind speed [m/s] = -1; allowed: finite and >= 0"});
    check_refused([] { (void)wt600_operation({.tower_shadow = 2}); }, {"rotor load: tower shadow = 2"});
    check_refused([] { (void)wt600_operation({.pitch = std::numeric_limits<double>::infinity()}); },
                  {"position = inf"});
    CHECK_THROWS_AS(wt600_kloss_curve("no_such_folder"), FileError);
}
