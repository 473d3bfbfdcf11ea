// Mechanisms with loops in time: benchmarks of the International Federation for the Promotion of Mechanism and Machine
// Science (IFToMM) and of the test set for initial value problems, order of convergence, drift, events, checkpoints.
#include "elements/machine_elements/point_spring.hpp"
#include "tests/mbs/loops/closed_trees.hpp"
#include "tests/oracles/pendulum.hpp"
#include "tests/solvers/time/integrated_systems.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace closed_loop_tests {

constexpr Method closing[] = {Method::dirk, Method::erk, Method::bdf};

double largest_gap(const System& system, const DynamicState& at) {
    Workspace workspace(system.model);
    Vector phi(system.loops.size());
    system.loops.residual<double>(kinematics(system.model, at.q, workspace), at.time, at.q, phi);
    return phi.lpNorm<Eigen::Infinity>();
}
double largest_rate(const System& system, const DynamicState& at) {
    Workspace workspace(system.model);
    Matrix G(system.loops.size(), system.model.size());
    system.loops.gradient<double>(kinematics(system.model, at.q, workspace), at.time, at.q, G);
    return (G * at.qd).lpNorm<Eigen::Infinity>();
}

// A point mass on two slides in the plane x, y, held to the origin by a rod: a pendulum in closed form.
struct RodPendulum {
    static constexpr double length = 1.3, start = 2.2;  // m; rad, from the lowest position

    RodPendulum() : system(make()) {}
    static System make() {
        Tree tree;
        const auto [x, y] = add_plane_mass(tree, 2);
        ForceSet forces;
        forces.set_gravity({0, -loop_gravity, 0});
        LoopSet loops;
        loops.add_distance({"rod", Tree::base(), y.axes, length});
        return {tree, forces, loops};
    }
    Vector position(double angle) const { return Vector{{length * std::sin(angle), -length * std::cos(angle)}}; }

    System system;
};

// Andrews' squeezing mechanism of seven bodies.                            [test set for initial value problem solvers]
struct Squeezer {
    Squeezer() : system(make()) {}
    static System make() {
        const Vec3 A(-0.06934, -0.00227, 0), B(-0.03635, 0.03273, 0), C(0.014, 0.072, 0);
        const auto body = [](double mass, double x, double y, double inertia) {
            // What turns about z only: the other moments do not matter.
            return RigidInertia{mass, {x, y, 0}, Vec3(inertia, inertia, inertia).asDiagonal().toDenseMatrix()};
        };
        Tree tree;
        const auto hinge = [&](const char* name, FrameId inboard, const RigidInertia& inertia) {
            return add_joint(tree, {.name = name, .inboard = inboard, .inertia = inertia});
        };
        const auto point = [&](const Link& link, double x, double y, const char* name) {
            return tree.add_frame(link.axes, Placement::translation({x, y, 0}), name);
        };
        const FrameId at_A = tree.add_frame(Tree::base(), Placement::translation(A), "A");
        const FrameId at_B = tree.add_frame(Tree::base(), Placement::translation(B), "B");
        const FrameId at_C = tree.add_frame(Tree::base(), Placement::translation(C), "C");
        const Link beta = hinge("beta", Tree::base(), body(0.04325, 0.00092, 0, 2.194e-6));
        const Link theta = hinge("Theta", point(beta, 0.007, 0, "crank"), body(0.00365, -0.0115, 0, 4.410e-7));
        const Link gamma = hinge("gamma", at_B, body(0.02373, 0.01043, -0.01874, 5.255e-6));
        const Link delta = hinge("delta", at_A, body(0.07050, 0.02308, 0.00916, 1.169e-5));
        const Link phi = hinge("phi", point(delta, 0.04, 0, "K5"), body(0.00706, 0, -(0.02 - 0.01421), 5.667e-7));
        const Link epsilon = hinge("epsilon", at_A, body(0.05498, 0.01228, 0.00449, 1.912e-5));
        const Link omega = hinge("Omega", point(epsilon, 0, -0.04, "K7"), body(0.00706, 0.02 - 0.01421, 0, 5.667e-7));
        const FrameId E = point(theta, -0.028, 0, "E");
        LoopSet loops;
        loops.add_joint({"E on K3", CutKind::revolute, E, point(gamma, 0, -0.035, "K3 end")});
        loops.add_joint({"E on K4", CutKind::revolute, E, point(phi, 0, -0.02, "K4 end")});
        loops.add_joint({"E on K6", CutKind::revolute, E, point(omega, 0.02, 0, "K6 end")});
        ForceSet forces;
        add_point_spring(
            forces,
            {.name = "spring", .a = at_C, .b = point(gamma, 0.02, -0.018, "D"), .stiffness = 4530, .length = 0.07785});
        forces.add_wrench({.name = "motor", .frame = beta.axes, .wrench = {Vec3::Zero(), Vec3(0, 0, 0.033)}});
        return {tree, forces, loops};
    }
    Vector vector(const std::array<double, 7>& values) const {
        const char* const names[] = {"beta", "Theta", "gamma", "phi", "delta", "Omega", "epsilon"};
        Vector q(7);
        for (std::size_t i = 0; i < 7; ++i) q(system.model.index(std::string_view(names[i]))) = values[i];
        return q;
    }

    System system;
};

}  // namespace closed_loop_tests

using namespace closed_loop_tests;

TEST_CASE("closed loops: a mass on a rod is the pendulum, at every order", "[analytic]") {
    const RodPendulum machine;
    const double span = 1.7;
    const oracles::SwingingPendulum pendulum(std::sqrt(loop_gravity / machine.length), machine.start);
    const Vector exact = machine.position(pendulum.angle(span));
    const Vector start = machine.position(machine.start);
    for (const Method method : {Method::dirk, Method::erk}) {
        std::vector<double> errors;
        for (const double step : {0.02, 0.01}) {
            IntegrationOptions options = with(method, 1e-12, 1e-12);
            options.fixed_step = step;
            Integrator run(machine.system, {}, 0, start, Vector::Zero(2), options);
            REQUIRE(run.advance(span).reached());
            errors.push_back((run.state().q - exact).norm());
            CHECK(largest_gap(machine.system, run.state()) < 1e-13);
            CHECK(largest_rate(machine.system, run.state()) < 1e-12);
        }
        CAPTURE(static_cast<int>(method), errors[0], errors[1]);
        CHECK(errors[1] < 1e-7);
        CHECK(observed_order(errors[0], errors[1]) > 4.7);
    }
    for (const Method method : closing) {
        CAPTURE(static_cast<int>(method));
        Integrator run(machine.system, {}, 0, start, Vector::Zero(2), with(method, 1e-9, 1e-10));
        REQUIRE(run.advance(span).reached());
        CHECK((run.state().q - exact).norm() < 1e-6);
        // The rod pulls with m (g cos + l omega^2).
        const double angle = pendulum.angle(span),
                     rate2 = 2 * loop_gravity / machine.length * (std::cos(angle) - std::cos(machine.start));
        CHECK(-run.state().lambda(0) ==
              Approx(2 * (loop_gravity * std::cos(angle) + machine.length * rate2)).epsilon(1e-5));
    }
}

TEST_CASE("closed loops: two windows of four-bars through their singular position", "[discrete]") {
    struct Row {
        double t, x, y, rate;
    };
    const std::vector<Row> rows = {{1, -0.1950203019, -0.9807992057, -6.8073852409},
                                   {2, 0.0578157958, 0.9983272679, -1.0189645914},
                                   {10, 0.3284581115, 0.9445185382, -1.5066421808}};
    for (const CutKind kind : {CutKind::cylindrical, CutKind::revolute}) {
        const Windows machine(2, kind);
        Integrator run(machine.system, {}, 0, machine.position(pi / 2), machine.rates(-1),
                       with(Method::dirk, 1e-10, 1e-11));
        const int first = machine.system.model.index("upright 0");
        for (const Row& row : rows) {
            CAPTURE(static_cast<int>(kind), row.t);
            REQUIRE(run.advance(row.t).reached());
            CHECK(std::cos(run.state().q(first)) == Approx(row.x).margin(1e-6));
            CHECK(std::sin(run.state().q(first)) == Approx(row.y).margin(1e-6));
            CHECK(run.state().qd(first) == Approx(row.rate).margin(1e-5));
            CHECK(largest_gap(machine.system, run.state()) < 1e-10);
        }
        CHECK(std::abs(run.energy().error) < 1e-4);
    }
}

TEST_CASE("closed loops: forty windows of four-bars", "[discrete][slow]") {
    const Windows machine(40, CutKind::cylindrical);
    Integrator run(machine.system, {}, 0, machine.position(pi / 2), machine.rates(-1), with(Method::dirk, 1e-9, 1e-10));
    const int first = machine.system.model.index("upright 0");
    REQUIRE(run.advance(1).reached());
    CHECK(std::cos(run.state().q(first)) == Approx(-0.1153568806).margin(1e-5));
    CHECK(run.state().qd(first) == Approx(-6.7148148807).margin(1e-4));
    REQUIRE(run.advance(10).reached());
    CHECK(std::cos(run.state().q(first)) == Approx(0.1805122267).margin(1e-4));
    CHECK(std::sin(run.state().q(first)) == Approx(0.9835727406).margin(1e-4));
}

TEST_CASE("closed loops: Bricard's, with one redundant equation of five", "[discrete]") {
    const Bricard machine;
    const System& system = machine.system;
    const Vector start = Vector::Zero(5);
    const Closure closed = close_loops(system.model, system.loops, start);
    REQUIRE(closed.converged);
    CHECK(closed.q.norm() < 1e-12);
    CHECK(closed.rank == 4);  // five coordinates, one freedom
    struct Row {
        double t;
        Vec3 x, v;
    };
    const std::vector<Row> rows = {
        {0.5, {0.774717808, -0.979815048, -0.199906159}, {-0.8269399, 0.1307072, -0.6406451}},
        {1, {0.274481319, -0.886707939, -0.462330003}, {-1.0949195, 0.1566991, -0.3005349}},
        {2, {-0.778135373, -0.980352683, -0.197252671}, {-0.8223593, -0.1287530, 0.6399068}},
        {3.7, {-0.048719990, -0.866709530, -0.498813181}, {1.1123966, 0.0311911, -0.0541960}},
        {10, {0.999730987, -0.999999964, -0.000268977}, {-0.0324533, 0.0000087, -0.0324446}}};
    Integrator run(system, {}, 0, start, Vector::Zero(5), with(Method::dirk, 1e-10, 1e-11));
    Workspace workspace(system.model);
    const FrameId P2 = system.model.frame("P2");
    for (const Row& row : rows) {
        CAPTURE(row.t);
        REQUIRE(run.advance(row.t).reached());
        const Kinematics kin = kinematics(system.model, run.state().q, workspace);
        Matrix J(6, 5);
        frame_jacobian<double>(kin, P2, J);
        CHECK((pose(kin, P2).p - row.x).norm() < 1e-6);
        CHECK((J.bottomRows(3) * run.state().qd - row.v).norm() < 1e-5);
        CHECK(largest_gap(system, run.state()) < 1e-12);
    }
    CHECK(std::abs(run.energy().error) < 1e-6);
}

TEST_CASE("closed loops: Andrews' squeezer", "[published]") {
    const Squeezer machine;
    const System& system = machine.system;
    const Vector start = machine.vector({-0.0617138900142764496, 0, 0.455279819163070380, 0.222668390165885885,
                                         0.487364979543842550, -0.222668390165885885, 1.23054744454982119});
    CHECK(close_loops(system.model, system.loops, start).gap < 1e-12);
    struct Row {
        double t;
        std::array<double, 7> q;
    };
    const std::vector<Row> rows = {
        {0.01, {2.16011313, -1.88336423, 0.15851676, -0.32864108, 0.52515477, 0.32864108, 1.06842720}},
        {0.02, {8.18490589, -7.89050536, 0.20953691, -0.23832560, 0.52253692, 0.23832560, 1.08627511}},
        {0.03, {15.81077119, -15.75637105, 0.04082224, -0.53473012, 0.52440997, 0.53473012, 1.04808074}}};
    Integrator run(system, {}, 0, start, Vector::Zero(7), with(Method::dirk, 1e-10, 1e-11));
    for (const Row& row : rows) {
        CAPTURE(row.t);
        REQUIRE(run.advance(row.t).reached());
        CHECK((run.state().q - machine.vector(row.q)).lpNorm<Eigen::Infinity>() < 1e-6);
        CHECK(largest_gap(system, run.state()) < 1e-13);
    }
}

TEST_CASE("closed loops: events, checkpoints and outputs", "[analytic]") {
    const RodPendulum machine;
    const System& system = machine.system;
    const Vector start = machine.position(machine.start);
    const oracles::SwingingPendulum pendulum(std::sqrt(loop_gravity / machine.length), machine.start);
    IntegrationOptions options = with(Method::dirk, 1e-10, 1e-11);
    options.events.push_back({.name = "lowest", .function = [](const StateView& at) { return at.q(0); }});
    Integrator run(system, {}, 0, start, Vector::Zero(2), options);
    const Advance end = run.advance(10);
    CHECK(end.event == "lowest");
    CHECK(std::abs(run.state().q(1) + machine.length) < 1e-12);
    CHECK(std::abs(pendulum.angle(end.time)) < 1e-8);
    CHECK(largest_gap(system, run.state()) < 1e-13);
    CHECK(largest_rate(system, run.state()) < 1e-12);

    // Continued from a checkpoint within a step, bit for bit.
    options.events.clear();
    Integrator whole(system, {}, 0, start, Vector::Zero(2), options);
    REQUIRE(whole.advance(0.777).reached());
    const Checkpoint from = whole.checkpoint();
    REQUIRE(whole.advance(2).reached());
    Integrator continued(system, {}, from, options);
    REQUIRE(continued.advance(2).reached());
    CHECK(continued.state().q == whole.state().q);
    CHECK(continued.state().qd == whole.state().qd);
    CHECK(continued.statistics().restarts == 0);
}

TEST_CASE("closed loops: continued from any checkpoint, a run goes on bit for bit", "[property]") {
    const FourBar machine(CoordinateRole::free);
    const System& system = machine.system;
    const Closure closed = close_loops(system.model, system.loops, FourBar::position(1, 1, 2), {.fixed = {0}});
    const Vector rates = close_rates(system.model, system.loops, closed.q, Vec3(9, 0, 0), {.fixed = {0}});
    for (const Method method : {Method::dirk, Method::erk}) {
        const IntegrationOptions options = with(method, 1e-7, 1e-8);
        Integrator whole(system, {}, 0, closed.q, rates, options);
        std::vector<Checkpoint> checkpoints;
        for (int i = 1; i <= 49; ++i) {
            REQUIRE(whole.advance(0.0131 * i).reached());
            checkpoints.push_back(whole.checkpoint());
        }
        REQUIRE(whole.advance(0.7).reached());
        for (const Checkpoint& from : checkpoints) {
            CAPTURE(static_cast<int>(method), from.time);
            Integrator continued(system, {}, from, options);
            CHECK(continued.state().q == from.q);
            REQUIRE(continued.advance(0.7).reached());
            CHECK(continued.state().q == whole.state().q);
            CHECK(continued.state().qd == whole.state().qd);
            CHECK(continued.state().lambda == whole.state().lambda);
            CHECK(continued.statistics().restarts == 0);
        }
    }
}

TEST_CASE("closed loops: constraints that move do work, couplings none", "[analytic]") {
    // A mass m that a constraint x = a sin(w t) moves: force m x'', work the change of kinetic energy.
    Tree tree;
    const Link slide = add_joint(
        tree,
        {.name = "x", .kind = JointKind::prismatic, .axis = Vec3::UnitX(), .inertia = {3, Vec3::Zero(), Mat3::Zero()}});
    const Link wheel = add_joint(tree, {.name = "wheel", .inertia = {1, Vec3::Zero(), 0.5 * Mat3::Identity()}});
    const Link other = add_joint(tree, {.name = "pinion", .inertia = {1, Vec3::Zero(), 0.2 * Mat3::Identity()}});
    ForceSet forces;
    forces.add_wrench({.name = "torque", .frame = other.axes, .wrench = {Vec3::Zero(), Vec3(0, 0, 1.4)}});
    LoopSet loops;
    constexpr double a = 0.2, w = 3;
    loops.add_user({"shaker", "m", [](double t, const Vector& q, ConstraintTerms& out) {
                        out.value = q(0) - a * std::sin(w * t);
                        out.gradient(0) = 1;
                        out.rate = -a * w * std::cos(w * t);
                        out.rate_rate = a * w * w * std::sin(w * t);
                    }});
    loops.add_coupling({"gear", {{wheel.body, 2.0}, {other.body, 1.0}}, 0, "rad"});  // pinion = -2 wheel
    const System system(tree, forces, loops);
    const Vector start = Vector::Zero(3), rates = close_rates(system.model, system.loops, start, Vector::Zero(3));
    CHECK(rates(0) == Approx(a * w));
    const double t = 1.1;
    for (const Method method : closing) {
        CAPTURE(static_cast<int>(method));
        Integrator run(system, {}, 0, start, rates, with(method, 1e-9, 1e-10));
        REQUIRE(run.advance(t).reached());
        const DynamicState& s = run.state();
        const int shaker = system.loops.first_of(1);
        CHECK(s.q(0) == Approx(a * std::sin(w * t)).epsilon(1e-9));
        CHECK(s.lambda(shaker) == Approx(-3 * a * w * w * std::sin(w * t)).epsilon(1e-9));
        const double wheel_acceleration = -2 * 1.4 / (0.5 + 4 * 0.2);
        CHECK(s.q(1) == Approx(wheel_acceleration * t * t / 2).epsilon(1e-6));
        CHECK(s.q(2) == Approx(-2 * s.q(1)).epsilon(1e-12));
        CHECK(run.energy().drives == Approx(3 * (s.qd(0) * s.qd(0) - rates(0) * rates(0)) / 2).epsilon(1e-5));
        CHECK(std::abs(run.energy().error) < 1e-6);
    }
    (void)slide;
}

TEST_CASE("closed loops: a drift of nothing in a million steps", "[slow]") {
    const RodPendulum machine;
    IntegrationOptions options = with(Method::erk);
    options.fixed_step = 1e-3;
    options.integrate_work = false;
    Integrator run(machine.system, {}, 0, machine.position(machine.start), Vector::Zero(2), options);
    double gap = 0, rate = 0;
    for (int i = 1; i <= 1000; ++i) {
        REQUIRE(run.advance(i).reached());
        gap = std::max(gap, largest_gap(machine.system, run.state()));
        rate = std::max(rate, largest_rate(machine.system, run.state()));
    }
    CHECK(run.statistics().steps >= 1000000);
    CHECK(gap < 1e-10);
    CHECK(rate < 1e-10);
}

TEST_CASE("closed loops: starts and methods that do not fit are refused", "[bad-input]") {
    const FourBar machine(CoordinateRole::free);
    const System& system = machine.system;
    const Vector open = FourBar::position(1, 1, 2);
    check_refused([&] { Integrator(system, {}, 0, open, Vector::Zero(3)); },
                  {"pin B", "gap at the start", "close_loops"});
    const Closure closed = close_loops(system.model, system.loops, open);
    REQUIRE(closed.converged);
    for (const Method method : {Method::adams, Method::generalised_alpha})
        check_refused([&] { Integrator(system, {}, 0, closed.q, Vector::Zero(3), with(method)); },
                      {"method for a system with loops"});
    // Crank and rocker at rates that do not belong together.
    std::vector<Drive> both = {{0, Motion::constant_rate(closed.q(0), 1)},
                               {system.model.index("rocker"), Motion::constant_rate(closed.q(2), 1)}};
    const std::vector<int> held = {0, 2};
    check_refused(
        [&] {
            (void)close_rates(system.model, system.loops, closed.q, Vector{{1, 0, 1}}, {.fixed = held});
        },
        {"pin B", "contradict"});
    check_refused(
        [&] {
            Integrator(system, both, 0, closed.q, Vector{{1, 0, 1}});
        },
        {"pin B", "opens at the start", "contradict"});
    // At rates that do so at the start only.
    const Vector fit = close_rates(system.model, system.loops, closed.q, Vector{{1, 0, 0}}, {.fixed = {0}});
    both[1].motion = Motion::constant_rate(closed.q(2), fit(2));
    for (const Method method : closing) {
        CAPTURE(static_cast<int>(method));
        Integrator run(system, both, 0, closed.q, fit, with(method));
        const Advance end = run.advance(1);
        CHECK(end.end == Advance::End::failed);
        CHECK(end.message.find("pin B") != std::string::npos);
        CHECK(largest_gap(system, run.state()) < 1e-5);  // the last state that there was
    }
}
