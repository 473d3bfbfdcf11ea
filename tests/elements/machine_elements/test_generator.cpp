// Laws of generators: Kloss' formula against the circuit it comes from, tables, exact derivatives, machines on a shaft.
#include "elements/machine_elements/generator.hpp"
#include "tests/elements/machine_elements/shaft.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/refusal.hpp"

#include <limits>
#include <random>

using namespace cardan;
using namespace cardan::testing;

namespace {

constexpr KlossCurve machine{157.0, 9000, 0.06};

Generator on_shaft(BodyId shaft, double ratio = 50) {
    Generator generator;
    generator.shaft = shaft;
    generator.gear_ratio = ratio;
    generator.law = machine;
    return generator;
}

TorqueTable table() {
    return {{100, 110, 125, 140, 150}, {0, 300, 2000, 2500, 2500}};
}

}  // namespace

TEST_CASE("induction machine: torque of the circuit with rotor resistance and leakage reactance", "[analytic]") {
    // One phase: V drives I through R / slip + j X; torque of three phases |I|^2 R / (slip w). Slip of a motor.
    const double V = 400, R = 0.012, X = 0.2, w = machine.synchronous_speed;
    const KlossCurve own{w, 3 * V * V / (2 * w * X), R / X};
    for (double slip : {-0.9, -0.2, -0.06, -0.01, 1e-4, 0.03, 0.06, 0.5, 1.0}) {
        const Complex I = V / Complex(R / slip, X);
        const double motor = 3 * std::norm(I) * R / (slip * w);
        CHECK(own.torque(w * (1 - slip)) == Approx(-motor).epsilon(1e-12));
    }
}

TEST_CASE("induction machine: largest torque at the breakdown slip, twice breakdown torque over slip near synchronism",
          "[analytic]") {
    const double w = machine.synchronous_speed, T = machine.breakdown_torque, s = machine.breakdown_slip;
    CHECK(machine.torque(w * (1 + s)) == Approx(T).epsilon(1e-14));
    CHECK(machine.torque(w * (1 - s)) == Approx(-T).epsilon(1e-14));
    CHECK(machine.slope(w * (1 + s)) == Approx(0).margin(1e-10));
    CHECK(machine.torque(w) == 0);
    CHECK(machine.slope(w) == Approx(2 * T / (s * w)).epsilon(1e-14));
    // At a small slip the torque is the slope's but for its square; at half the breakdown slip four fifths of T.
    CHECK(machine.torque(w * (1 + s / 100)) == Approx(0.02 * T).epsilon(1.01e-4));
    CHECK(machine.torque(w * (1 + s / 2)) == Approx(0.8 * T).epsilon(1e-13));
    for (double x : {0.0, 0.3, 0.5, 0.9, 0.97, 1.01, 1.06, 1.3, 2.0}) {
        CHECK(std::abs(machine.torque(w * x)) <= T * (1 + 1e-14));
        CHECK(machine.slope(w * x) ==
              Approx(complex_slope([](Complex v) { return machine.torque(v); }, w * x)).margin(1e-12 * T));
    }
}

TEST_CASE("generator: on the slow side torque times the gear ratio, against positive rotation above synchronism",
          "[analytic]") {
    const auto at = [](double ratio, double rate) {
        return evaluate(
            Shaft{}.system([&](BodyId wheel) { return std::vector{generator_force(on_shaft(wheel, ratio))}; }), 0, 0.3,
            rate);
    };
    const double slow = 1.01 * machine.synchronous_speed / 50;
    const OneForce f = at(50, slow);
    CHECK(f.Q == Approx(-50 * machine.torque(50 * slow)).epsilon(1e-14));
    CHECK(f.Q < 0);
    CHECK(f.by_q == 0);
    CHECK(f.by_qd == Approx(-2500 * machine.slope(50 * slow)).epsilon(1e-14));
    CHECK(at(50, 0.99 * slow).Q == Approx(-50 * machine.torque(0.99 * 50 * slow)).epsilon(1e-14));
    // A machine that turns the other way brakes the shaft's negative rotation.
    CHECK(at(-50, -slow).Q == Approx(-f.Q).epsilon(1e-14));
    CHECK(at(-50, -slow).by_qd == Approx(f.by_qd).epsilon(1e-14));
    const Generator generator = on_shaft({}, -50);
    CHECK(generator.power(-slow) == Approx(machine.torque(50 * slow) * 50 * slow).epsilon(1e-14));
}

TEST_CASE("generator: off the grid there is no torque; copies of a force share the switch", "[property]") {
    const auto grid = std::make_shared<Switch>(true);
    const System system = Shaft{}.system([&](BodyId wheel) {
        Generator generator = on_shaft(wheel);
        generator.grid = grid;
        return std::vector{generator_force(generator)};
    });
    const Forces copy = system.forces.with_gravity(system.forces.gravity());
    Workspace workspace(system.model);
    const auto torque = [&](const Forces& forces) {
        const Vector q = one(0), qd = one(3.2);
        Vector Q(1);
        forces.generalised_forces({{.q = q, .qd = qd}, kinematics(system.model, q, workspace)}, Q);
        return Q(0);
    };
    CHECK(torque(copy) < -1e5);
    CHECK(grid->since() == -std::numeric_limits<double>::infinity());
    grid->turn(false, 4);
    CHECK(torque(system.forces) == 0);
    CHECK(torque(copy) == 0);
    CHECK(evaluate(system, 5, 0, 3.2).by_qd == 0);
    grid->turn(false, 5);
    CHECK(grid->since() == 4);
    grid->turn(true, 6);
    CHECK(grid->since() == 6);
    CHECK(torque(copy) < -1e5);
    grid->reset(false);
    CHECK_FALSE(grid->is_on());
    CHECK(grid->since() == -std::numeric_limits<double>::infinity());
}

TEST_CASE("generator: a driven shaft settles where the torques are equal, at the rate of the slope", "[analytic]") {
    // Slip of the smaller root of T_b (2 r / (1 + r^2)) = M; near it the speed decays as exp(-slope t / J).
    const Shaft shaft{.J = 800, .moment = 200e3};
    const double M = shaft.moment / 50, r = 9000 / M - std::sqrt(std::pow(9000 / M, 2) - 1);
    const double settled = machine.synchronous_speed * (1 + r * machine.breakdown_slip) / 50;
    const System system = shaft.system([](BodyId wheel) { return std::vector{generator_force(on_shaft(wheel))}; });
    const double off = 1e-6 * settled, T = shaft.J / (2500 * machine.slope(50 * settled));
    solvers::IntegrationOptions options = accurate(1e-12);
    solvers::Integrator integrator(system, {}, 0, one(0), one(settled + off), options);
    REQUIRE(integrator.advance(T).reached());
    CHECK(integrator.state().qd(0) - settled == Approx(off * std::exp(-1)).epsilon(1e-4));
    CHECK(integrator.energy().loads ==
          Approx(integrator.energy().kinetic - shaft.J * std::pow(settled + off, 2) / 2).margin(1e-6 * shaft.moment));
}

TEST_CASE("torque table: passes through its points, monotone between them, level outside, with continuous slope",
          "[property]") {
    const std::vector<double> speeds{100, 110, 125, 140, 150}, torques{0, 300, 2000, 2500, 2500};
    const TorqueTable t = table();
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        CHECK(t.torque(speeds[i]) == Approx(torques[i]).margin(1e-12));
        CHECK(t.slope(speeds[i] - 1e-9) == Approx(t.slope(speeds[i] + 1e-9)).margin(1e-4));
    }
    for (double v : {-200.0, 0.0, 99.9}) {
        CHECK(t.torque(v) == 0);
        CHECK(t.slope(v) == 0);
    }
    CHECK(t.torque(400) == 2500);
    for (double v = 90; v < 160; v += 0.37) {
        CHECK(t.slope(v) >= 0);
        constexpr double h = 1e-4;
        CHECK(t.slope(v) == Approx((t.torque(v + h) - t.torque(v - h)) / (2 * h)).margin(1e-3));
    }
    // Linear between two points of a line that has more of it on both sides.
    const TorqueTable line({0, 1, 2, 3, 5}, {0, 2, 4, 6, 10});
    for (double v : {1.0, 1.3, 2.0, 2.8}) CHECK(line.torque(v) == Approx(2 * v).epsilon(1e-14));
}

TEST_CASE("generator: a table acts as a force with its exact slope, without allocation", "[property]") {
    const System system = Shaft{}.system([](BodyId wheel) {
        Generator generator = on_shaft(wheel, 40);
        generator.law = table();
        return std::vector{generator_force(generator)};
    });
    for (double rate : {2.6, 3.0, 3.3}) {
        const OneForce f = evaluate(system, 0, 0, rate);
        CHECK(f.Q == Approx(-40 * table().torque(40 * rate)).epsilon(1e-14));
        CHECK(f.by_qd == Approx(-1600 * table().slope(40 * rate)).epsilon(1e-14));
    }
    Workspace workspace(system.model);
    const State state{.q = one(0), .qd = one(3)};
    Vector Q(1);
    ForceDerivatives d;
    const auto call = [&] {
        const StateView at(state, kinematics(system.model, state.q, workspace));
        system.forces.generalised_forces(at, Q);
        system.forces.derivatives(at, d);
    };
    call();
    if (AllocationGuard::works()) CHECK(allocations(call) == 0);
}

TEST_CASE("generator: its channels are torque on its own shaft and power", "[property]") {
    const System system = Shaft{}.system([](BodyId) { return std::vector<ForceElement>{}; });
    const ChannelGroup group = generator_channels(on_shaft(BodyId{0}));
    REQUIRE(group.channels.size() == 2);
    CHECK(group.channels[0].alias == "GenTq");
    const Vector q = one(0), qd = one(3.2), none = one(0);
    Workspace workspace(system.model);
    const Kinematics kin = kinematics(system.model, q, workspace);
    double values[2];
    group.sample({{{.q = q, .qd = qd}, none, {}, none}, kin, system.forces, system.loops}, values);
    CHECK(values[0] == machine.torque(160.0));
    CHECK(values[1] == Approx(160 * machine.torque(160.0)).epsilon(1e-14));
}

TEST_CASE("generator: bad numbers are refused", "[property]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto make = [](const KlossCurve& law, double ratio) {
        Generator generator = on_shaft({}, ratio);
        generator.law = law;
        (void)generator_force(generator);
    };
    check_refused([&] { make(machine, 0); }, {"generator: gear ratio = 0; allowed: finite and not zero"});
    check_refused([&] { make(machine, nan); }, {"gear ratio = nan"});
    check_refused([&] { make({0, 1, 1}, 1); }, {"generator: synchronous speed [rad/s] = 0"});
    check_refused([&] { make({1, -1, 1}, 1); }, {"breakdown torque [N m] = -1"});
    check_refused([&] { make({1, 1, nan}, 1); }, {"breakdown slip = nan"});
    check_refused([] { TorqueTable({1}, {1}); }, {"torque table: number of speeds = 1; allowed: >= 2"});
    check_refused([] { TorqueTable({1, 2}, {1}); }, {"number of torques = 1; allowed: 2, one per speed"});
    check_refused([] { TorqueTable({1, 3, 3}, {1, 2, 3}); }, {"speed 3 [rad/s] = 3; allowed: > 3, the one before"});
    check_refused([&] { TorqueTable({1, nan}, {1, 2}); }, {"speed 2 [rad/s] = nan"});
    check_refused([&] { TorqueTable({1, 2}, {1, nan}); }, {"torque 2 [N m] = nan"});
}
