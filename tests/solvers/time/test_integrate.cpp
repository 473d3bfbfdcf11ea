#include "tests/solvers/time/integrated_systems.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/simulation.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

TEST_CASE("integrate: a damped oscillator follows the closed solution with every method",
          "[solvers][integrate][analytic]") {
    const Oscillator oscillator;
    const System system = oscillator.system();
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        Integrator integrator(system, {}, 0, vector({0.3}), vector({0}), with(method));
        for (double t : {0.01, 0.5, 1.0, 3.0}) {
            CHECK(integrator.advance(t).reached());
            CHECK(integrator.time() == t);
            CAPTURE(t);
            CHECK(std::abs(integrator.state().q(0) - oscillator.position(t)) < allowed(method));
        }
        const IntegrationStatistics statistics = integrator.statistics();
        CHECK(statistics.steps > 10);
        CHECK(statistics.evaluations >= statistics.steps);
        CHECK(statistics.last_step > 0);
        CHECK(statistics.restarts == 0);
        CHECK(statistics.not_converged == 0);
        CHECK((statistics.jacobians > 0) == (method != Method::adams && method != Method::erk));
    }
}

TEST_CASE("integrate: a pendulum follows the elliptic functions with every method", "[solvers][integrate][analytic]") {
    const System system = pendulum();
    const oracles::SwingingPendulum oracle(pendulum_omega, 2.5);
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        Integrator integrator(system, {}, 0, vector({2.5}), vector({0}), with(method));
        for (double part : {0.1, 0.5, 1.0, 1.7}) {
            const double t = part * oracle.period();
            CHECK(integrator.advance(t).reached());
            CHECK(std::abs(integrator.state().q(0) - oracle.angle(t)) < 10 * allowed(method));
            CHECK(std::abs(integrator.state().qd(0) - oracle.rate(t)) < 30 * allowed(method));
        }
    }
}

TEST_CASE("integrate: a driven cart moves the mass and needs the force of the closed solution",
          "[solvers][integrate][analytic]") {
    const Shaker shaker;
    const System system = shaker.system();
    // Steady answer of m (x'' + s'') + k x = 0 to s = a sin(w t): x = b sin(w t).
    const double a = 0.1, w = 3, b = shaker.m * w * w * a / (shaker.k - shaker.m * w * w);
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        Integrator integrator(system, {{0, Motion::harmonic(0, a, 2 * pi / w)}}, 0, vector({0, 0}), vector({0, b * w}),
                              with(method));
        for (double t : {0.4, 1.9, 4.0}) {
            CHECK(integrator.advance(t).reached());
            const DynamicState& now = integrator.state();
            CHECK(now.q(0) == Approx(a * std::sin(w * t)));
            CHECK(now.qd(0) == Approx(a * w * std::cos(w * t)));
            CHECK(std::abs(now.q(1) - b * std::sin(w * t)) < allowed(method));
            const double force = -w * w * std::sin(w * t) * ((shaker.cart + shaker.m) * a + shaker.m * b);
            CHECK(std::abs(now.actuator(0) - force) < 200 * allowed(method));
            CHECK(now.actuator(1) == 0);
        }
    }
}

TEST_CASE("integrate: a driven coordinate without a motion keeps its rate", "[solvers][integrate][property]") {
    const System system = Shaker().system();
    Integrator integrator(system, {}, 2, vector({1, 0}), vector({0.5, 0}), {});
    CHECK(integrator.advance(4).reached());
    CHECK(integrator.state().q(0) == Approx(2));
    CHECK(integrator.state().actuator(0) == Approx(0).margin(1e-9));
}

TEST_CASE("integrate: generalised alpha with fixed steps is of second order", "[solvers][integrate][analytic]") {
    const System system = pendulum();
    const oracles::SwingingPendulum oracle(pendulum_omega, 1.5);
    const double t = 0.8 * oracle.period();
    for (double radius : {0.0, 0.5, 0.8, 1.0}) {
        const auto error = [&](int steps) {
            IntegrationOptions options = with(Method::generalised_alpha);
            options.spectral_radius = radius;
            options.fixed_step = t / steps;
            Integrator integrator(system, {}, 0, vector({1.5}), vector({0}), options);
            CHECK(integrator.advance(t).reached());
            return Eigen::Vector2d(integrator.state().q(0) - oracle.angle(t), integrator.state().qd(0) - oracle.rate(t))
                .norm();
        };
        const double coarse = error(200), fine = error(400);
        CAPTURE(radius, coarse, fine);
        CHECK(std::log2(coarse / fine) == Approx(2).margin(0.1));
    }
}

TEST_CASE("integrate: generalised alpha takes as many steps as its local errors ask for",
          "[solvers][integrate][crosscheck]") {
    // A double pendulum at the default tolerances; each fifth step again by small steps of a method of order five.
    Tree tree;
    ForceSet forces;
    const Link upper =
        add_joint(tree, {.name = "upper", .axis = Vec3::UnitY(), .inertia = {1, Vec3(0, 0, -1), Mat3::Zero()}});
    const FrameId end = tree.add_frame(upper.axes, Placement::translation({0, 0, -1}), "end");
    add_joint(tree,
              {.name = "lower", .inboard = end, .axis = Vec3::UnitY(), .inertia = {1, Vec3(0, 0, -1), Mat3::Zero()}});
    forces.set_gravity({0, 0, -pendulum_gravity});
    const System system(tree, forces);
    IntegrationOptions options;
    options.method = Method::generalised_alpha;
    const Tolerances allowed = options.tolerances;
    Integrator integrator(system, {}, 0, vector({2, 0.5}), vector({0, 0}), options);
    REQUIRE(integrator.advance(0.5).reached());
    std::vector<double> errors;
    for (int k = 0; k < 1000; ++k) {
        const DynamicState from = integrator.state();
        REQUIRE(integrator.step().reached());
        if (k % 5 != 0) continue;
        Integrator again(system, {}, from.time, from.q, from.qd, with(Method::dirk, 1e-12, 1e-13));
        REQUIRE(again.advance(integrator.time()).reached());
        double square = 0;
        for (int i = 0; i < 2; ++i) {
            const double q = allowed.angle + allowed.relative * std::min(1.0, std::abs(from.q(i)));
            const double qd = allowed.angular_rate + allowed.relative * std::abs(from.qd(i));
            square += std::pow((integrator.state().q(i) - again.state().q(i)) / q, 2) +
                      std::pow((integrator.state().qd(i) - again.state().qd(i)) / qd, 2);
        }
        errors.push_back(std::sqrt(square / 4));
    }
    std::ranges::sort(errors);
    CAPTURE(errors.front(), errors[errors.size() / 2], errors.back());
    CHECK(errors[errors.size() / 2] > 0.4);
    CHECK(errors[errors.size() * 9 / 10] < 1.2);
}

TEST_CASE("integrate: Runge-Kutta methods with fixed steps are of order five", "[solvers][integrate][analytic]") {
    const System system = pendulum();
    const oracles::SwingingPendulum oracle(pendulum_omega, 1.5);
    const double t = 0.8 * oracle.period();
    for (Method method : {Method::dirk, Method::erk}) {
        const auto error = [&](int steps) {
            IntegrationOptions options = with(method, 1e-11, 1e-11);
            options.fixed_step = t / steps;
            options.breaks = {t};
            Integrator integrator(system, {}, 0, vector({1.5}), vector({0}), options);
            CHECK(integrator.advance(t).reached());
            return std::abs(integrator.state().q(0) - oracle.angle(t)) +
                   std::abs(integrator.state().qd(0) - oracle.rate(t));
        };
        const double coarse = error(100), fine = error(200);
        CAPTURE(static_cast<int>(method), coarse, fine);
        CHECK(std::log2(coarse / fine) == Approx(5).margin(0.4));
    }
}

TEST_CASE("integrate: energies, losses and supplies are in balance", "[solvers][integrate][property]") {
    for (Method method : methods) {
        for (double damping : {0.0, 0.4}) {
            const System system = chain(damping, CoordinateRole::prescribed);
            Integrator integrator(system, {{0, Motion::rate_ramp(0.2, 0, 1.5, 0.3, 1.1)}}, 0, vector({0.2, 0.5, -0.4}),
                                  vector({0, 0, 0}), with(method));
            CHECK(integrator.advance(2).reached());
            const EnergyBalance balance = integrator.energy();
            CAPTURE(static_cast<int>(method), damping, balance.kinetic, balance.drives, balance.dissipated);
            CHECK(std::abs(balance.error) < 100 * allowed(method));
            CHECK(std::abs(balance.loads) < 100 * allowed(method));
            CHECK((damping > 0 ? balance.dissipated > 0.05 : balance.dissipated == Approx(0).margin(1e-12)));
            CHECK(integrator.statistics().restarts == (is_multistep(method) ? 2 : 0));
        }
    }
}

TEST_CASE("integrate: across the points of a table it agrees with small steps of another method",
          "[solvers][integrate][crosscheck]") {
    const System system = chain(0.3, CoordinateRole::prescribed);
    const Motion table = Motion::table({0, 0.4, 0.5, 1.0, 1.5}, {0, 0.1, 0.3, 0.2, 0.2});
    const Vector q0 = vector({0, 0.5, -0.4}), qd0 = vector({table.at(0).velocity, 0, 0});
    double inside = 0;
    Simulation simulation(system, q0, qd0, [&](double t, int) { return table.at(t, inside).acceleration; });
    double begin = 0;
    for (double end : {0.4, 0.5, 1.0, 1.5}) {
        inside = (begin + end) / 2;
        simulation.advance(end - begin, 400);
        begin = end;
    }
    for (Method method : methods) {
        Integrator integrator(system, {{0, table}}, 0, q0, qd0, with(method));
        CAPTURE(static_cast<int>(method));
        CHECK(integrator.advance(1.5).reached());
        CHECK((integrator.state().q - simulation.q()).norm() < 3 * allowed(method));
        CHECK((integrator.state().qd - simulation.qd()).norm() < 10 * allowed(method));
        CHECK(integrator.statistics().restarts == (is_multistep(method) ? 3 : 0));
    }
}
