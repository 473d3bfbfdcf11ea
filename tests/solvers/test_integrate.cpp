#include "mbs/error.hpp"
#include "solvers/integrate.hpp"
#include "tests/oracles/pendulum.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/simulation.hpp"
#include "tests/support/tree_tools.hpp"

#include <cmath>
#include <stdexcept>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

constexpr Method methods[] = {Method::bdf, Method::adams, Method::dirk, Method::erk, Method::generalised_alpha};

Vector vector(std::initializer_list<double> values) {
    Vector v(static_cast<Eigen::Index>(values.size()));
    std::copy(values.begin(), values.end(), v.data());
    return v;
}

IntegrationOptions with(Method method, double relative = 1e-8, double absolute = 1e-10) {
    IntegrationOptions options;
    options.method = method;
    options.tolerances = {relative, absolute, absolute, absolute, absolute};
    return options;
}

// Local errors of 1e-8 in a thousand steps, in ten thousand of the method of second order.
double allowed(Method method) {
    return method == Method::generalised_alpha ? 1e-4 : 1e-5;
}

// A mass on a spring and a damper along z.
struct Oscillator {
    double m = 2, k = 50, c = 1.2;
    double omega0() const { return std::sqrt(k / m); }
    double decay() const { return c / (2 * m); }
    double omega() const { return std::sqrt(omega0() * omega0() - decay() * decay()); }
    double position(double t) const {  // from 0.3 at rest
        return 0.3 * std::exp(-decay() * t) * (std::cos(omega() * t) + decay() / omega() * std::sin(omega() * t));
    }
    System system(std::vector<UserForce> users = {}) const {
        Tree tree;
        ForceSet forces;
        const Link mass = add_joint(
            tree, {.name = "slider", .kind = JointKind::prismatic, .inertia = {m, Vec3::Zero(), Mat3::Zero()}});
        if (k > 0) forces.add_spring("spring", mass.body, k, c);
        for (UserForce& user : users) forces.add_user(user);
        return {tree, forces};
    }
};

constexpr double gravity = 9.81;

// A point mass on an arm of 1.5 m.
System pendulum() {
    Tree tree;
    ForceSet forces;
    add_joint(tree, {.name = "hinge", .axis = Vec3::UnitY(), .inertia = {3, Vec3(0, 0, -1.5), Mat3::Zero()}});
    forces.set_gravity({0, 0, -gravity});
    return {tree, forces};
}
const double pendulum_omega = std::sqrt(gravity / 1.5);

// A cart that is driven along x and carries a mass on a spring along x.
struct Shaker {
    double cart = 4, m = 2, k = 50, c = 0;
    System system() const {
        Tree tree;
        ForceSet forces;
        const Link base = add_joint(tree, {.name = "cart",
                                           .kind = JointKind::prismatic,
                                           .axis = Vec3::UnitX(),
                                           .inertia = {cart, Vec3::Zero(), Mat3::Zero()},
                                           .role = CoordinateRole::driven});
        const Link mass = add_joint(tree, {.name = "mass",
                                           .inboard = base.axes,
                                           .kind = JointKind::prismatic,
                                           .axis = Vec3::UnitX(),
                                           .inertia = {m, Vec3::Zero(), Mat3::Zero()}});
        forces.add_spring("spring", mass.body, k, c);
        return {tree, forces};
    }
};

// A chain of three hinges under gravity with dampers; the first is driven in some tests.
System chain(double damping, CoordinateRole first = CoordinateRole::free) {
    Tree tree;
    ForceSet forces;
    FrameId at = Tree::base();
    const Vec3 axes[] = {Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitY()};
    for (int i = 0; i < 3; ++i) {
        const Link link =
            add_joint(tree, {.name = text("hinge ", i + 1),
                             .inboard = at,
                             .axis = axes[i],
                             .inertia = {2.0 - 0.4 * i, Vec3(0.1, 0, -0.5), Mat3(Vec3(0.1, 0.2, 0.15).asDiagonal())},
                             .role = i == 0 ? first : CoordinateRole::free});
        at = tree.add_frame(link.axes, Placement::translation({0, 0, -1}), text("end ", i + 1));
        forces.add_spring(text("spring ", i + 1), link.body, 5, damping);
    }
    forces.set_gravity({0, 0, -gravity});
    return {tree, forces};
}

}  // namespace

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

TEST_CASE("integrate: Runge-Kutta methods with fixed steps have their orders", "[solvers][integrate][analytic]") {
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
        CHECK(std::log2(coarse / fine) == Approx(method == Method::dirk ? 4 : 5).margin(0.4));
    }
}

TEST_CASE("integrate: energies, losses and supplies are in balance", "[solvers][integrate][property]") {
    for (Method method : methods) {
        for (double damping : {0.0, 0.4}) {
            const System system = chain(damping, CoordinateRole::driven);
            Integrator integrator(system, {{0, Motion::rate_ramp(0.2, 0, 1.5, 0.3, 1.1)}}, 0, vector({0.2, 0.5, -0.4}),
                                  vector({0, 0, 0}), with(method));
            CHECK(integrator.advance(2).reached());
            const EnergyBalance balance = integrator.energy();
            CAPTURE(static_cast<int>(method), damping, balance.kinetic, balance.drives, balance.dissipated);
            CHECK(std::abs(balance.error) < 100 * allowed(method));
            CHECK(std::abs(balance.loads) < 100 * allowed(method));
            CHECK((damping > 0 ? balance.dissipated > 0.05 : balance.dissipated == Approx(0).margin(1e-12)));
            CHECK(integrator.statistics().restarts == 2);
        }
    }
}

TEST_CASE("integrate: across the points of a table it agrees with small steps of another method",
          "[solvers][integrate][crosscheck]") {
    const System system = chain(0.3, CoordinateRole::driven);
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
        CHECK(integrator.statistics().restarts == 3);
    }
}

TEST_CASE("integrate: events are found where they happen, in their direction", "[solvers][integrate][analytic]") {
    const System system = pendulum();
    const oracles::SwingingPendulum oracle(pendulum_omega, 1.2);
    const double quarter = oracle.period() / 4;
    const auto angle = [](const ForceInput& at) { return at.q(0); };
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        IntegrationOptions options = with(method);
        options.events = {{.name = "upwards", .function = angle, .direction = 1}};
        Integrator rising(system, {}, 0, vector({1.2}), vector({0}), options);
        Advance advance = rising.advance(10);
        CHECK(advance.end == Advance::End::event);
        CHECK(advance.message == "upwards");
        CHECK(std::abs(advance.time - 3 * quarter) < 10 * allowed(method));
        CHECK(std::abs(rising.state().q(0)) < 1e-9);
        advance = rising.advance(10);
        CHECK(std::abs(advance.time - 7 * quarter) < 20 * allowed(method));

        int passed = 0;
        options.events = {{.name = "bottom", .function = angle, .action = [&](Integrator&) {
                               ++passed;
                               return AfterEvent::go_on;
                           }}};
        Integrator both(system, {}, 0, vector({1.2}), vector({0}), options);
        CHECK(both.advance(8.5 * quarter).reached());
        CHECK(passed == 4);
    }
}

TEST_CASE("integrate: of events at the same time each acts, in the order of the list", "[solvers][integrate]") {
    const System system = pendulum();
    std::string seen;
    const auto event = [&](const char* name, int direction) {
        return Event{name, [](const ForceInput& at) { return at.q(0); }, direction,
                     [&seen, name](Integrator&) {
                         seen += name;
                         return AfterEvent::restart;
                     }};
    };
    IntegrationOptions options;
    options.events = {event("a", 0), event("b", -1), event("c", 1)};
    Integrator integrator(system, {}, 0, vector({0.5}), vector({0}), options);
    CHECK(integrator.advance(0.9 * oracles::SwingingPendulum(pendulum_omega, 0.5).period()).reached());
    CHECK(seen == "abac");
}

TEST_CASE("integrate: an event may change a motion, and the cart brakes", "[solvers][integrate][property]") {
    const System system = Shaker{.c = 3}.system();
    IntegrationOptions options = with(Method::bdf);
    options.events = {{.name = "end of the rail",
                       .function = [](const ForceInput& at) { return at.q(0) - 1; },
                       .direction = 1,
                       .action =
                           [](Integrator& integrator) {
                               const double t = integrator.time();
                               integrator.set_motion(0, Motion::rate_ramp(integrator.state().q(0), 0.5, 0, t, t + 1));
                               return AfterEvent::restart;
                           }}};
    Integrator integrator(system, {}, 0, vector({0, 0}), vector({0.5, 0}), options);
    CHECK(integrator.advance(20).reached());
    CHECK(integrator.state().q(0) == Approx(1.25));  // at 2 s, then half the rate for 1 s
    CHECK(integrator.state().qd(0) == 0);
    CHECK(std::abs(integrator.state().q(1)) < 1e-4);
    CHECK(std::abs(integrator.energy().error) < 1e-5);
    CHECK_THROWS_AS(integrator.set_motion(0, Motion::constant(7)), InputError);
    CHECK_THROWS_AS(integrator.set_motion(1, Motion::constant(7)), InputError);
}

TEST_CASE("integrate: a failure says when, why and which coordinate", "[solvers][integrate]") {
    // x'' = x^3 with x = sqrt(2) / (1 - t) ends in infinity at t = 1.
    const System system = Oscillator{.m = 1, .k = 0}.system(
        {{.name = "explosion",
          .force = [](const ForceInput& at, VectorOut Q) { Q(0) += at.q(0) * at.q(0) * at.q(0); },
          .jacobian = [](const ForceInput& at, MatrixOut by_q, MatrixOut) { by_q(0, 0) += 3 * at.q(0) * at.q(0); }}});
    for (Method method : methods) {
        Integrator integrator(system, {}, 0, vector({std::sqrt(2.0)}), vector({std::sqrt(2.0)}), with(method, 1e-5));
        const Advance advance = integrator.advance(2);
        CAPTURE(static_cast<int>(method), advance.message, advance.time);
        CHECK(advance.end == Advance::End::failed);
        CHECK(advance.time == Approx(1).margin(0.01));
        CHECK(advance.message.find("'slider'") != std::string::npos);
        CHECK(integrator.state().q.allFinite());
    }
}

TEST_CASE("integrate: exceptions of user forces pass through, and it can be cancelled", "[solvers][integrate]") {
    const System system = Oscillator{}.system({{.name = "thrower", .force = [](const ForceInput& at, VectorOut) {
                                                    if (at.time > 1) throw std::runtime_error("thrown by the force");
                                                }}});
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        Integrator integrator(system, {}, 0, vector({0.3}), vector({0}), with(method));
        CHECK_THROWS_WITH(integrator.advance(2), "thrown by the force");
        int asked = 0;
        IntegrationOptions options = with(method);
        options.cancelled = [&] { return ++asked > 5; };
        Integrator cancelled(system, {}, 0, vector({0.3}), vector({0}), options);
        CHECK(cancelled.advance(0.9).end == Advance::End::cancelled);
        CHECK(cancelled.statistics().steps == 5);
    }
}

TEST_CASE("integrate: steps allocate nothing", "[solvers][integrate][property]") {
    if (!AllocationGuard::works()) return;
    const System system = chain(0.3, CoordinateRole::driven);
    for (Method method : methods) {
        Integrator integrator(system, {{0, Motion::harmonic(0, 0.3, 1.5)}}, 0, vector({0, 0.5, -0.4}),
                              vector({0, 0, 0}), with(method, 1e-6, 1e-8));
        CHECK(integrator.advance(0.2).reached());
        bool reached = false;
        const std::size_t count = allocations([&] { reached = integrator.advance(2).reached(); });
        CAPTURE(static_cast<int>(method));
        CHECK(reached);
        CHECK(count == 0);
    }
}

TEST_CASE("integrate: bad input is refused", "[solvers][integrate]") {
    const System system = Shaker().system();
    const Vector zero = vector({0, 0});
    const auto make = [&](std::vector<Drive> drives, const Vector& q, IntegrationOptions options = {}) {
        Integrator(system, std::move(drives), 0, q, zero, std::move(options));
    };
    check_refused([&] { make({}, vector({0})); }, {"number of positions", "2, one per coordinate"});
    check_refused([&] { make({}, vector({0, NAN})); }, {"'mass'", "position at the start", "nan"});
    check_refused([&] { make({{2, Motion::constant(0)}}, zero); }, {"index of a driven coordinate", "0 ... 1"});
    check_refused([&] { make({{0, Motion::constant(0)}, {0, Motion::constant(0)}}, zero); }, {"cart", "one at most"});
    check_refused([&] { make({{1, Motion::constant(0)}}, zero); }, {"number of free coordinates"});
    check_refused([&] { make({}, zero, {.fixed_step = 0.1}); }, {"fixed step", "0.1"});
    check_refused([&] { make({}, zero, {.max_step = -1}); }, {"largest step", "-1"});
    check_refused([&] { make({}, zero, {.max_order = 6}); }, {"highest order", "6", "0 ... 5"});
    check_refused([&] { make({}, zero, {.spectral_radius = 1.5}); }, {"spectral radius", "1.5"});
    check_refused([&] { make({}, zero, {.tolerances = {.relative = 0}}); }, {"relative tolerance"});
    check_refused([&] { make({}, zero, {.events = {{.name = "nothing"}}}); }, {"event", "nothing"});
    Integrator integrator(system, {}, 1, zero, zero);
    check_refused([&] { (void)integrator.advance(0.5); }, {"time to advance to", "0.5"});
}
