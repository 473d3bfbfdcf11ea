// Load stepping on systems of one degree of freedom against balances by hand.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/equilibrium/equilibrium_path.hpp"
#include "tests/oracles/root_finding.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/tree_tools.hpp"

#include <cmath>
#include <limits>

namespace cardan::testing::load_paths {

using namespace solvers;
using oracles::bisect;

namespace {

constexpr double m = 2, length = 1.5, g = units::standard_gravity;

// A pendulum about y with a spring, gravity along -z and loads at its end; it hangs or stands.
struct Pendulum {
    double k = 0, moment = 0, side = -1;
    Vec3 force = Vec3::Zero();
    WrenchAxes axes = WrenchAxes::base;
    double gravity = g;

    System system() const {
        Tree tree;
        ForceSet forces;
        const Vec3 end(0, 0, side * length);
        const Link link = add_joint(tree, {.name = "hinge", .axis = Vec3::UnitY(), .inertia = {m, end}});
        const FrameId tip = tree.add_frame(link.axes, Placement::translation(end), "tip");
        if (k > 0) forces.add_spring("spring", link.body, k);
        forces.set_gravity({0, 0, -gravity});
        forces.add_wrench({"load", tip, {force, {0, moment, 0}}, axes});
        return System(tree, forces);
    }
};

void check_factors(const EquilibriumPath& path, const std::vector<double>& expected) {
    REQUIRE(path.points.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) CHECK(path.points[i].factor == expected[i]);
}

}  // namespace

TEST_CASE("load path: a hanging pendulum takes the angle of balance at every load factor", "[analytic]") {
    const double M = 0.95 * m * g * length;
    const System system = Pendulum{.moment = M}.system();
    const EquilibriumPath path = equilibrium_path(system, {.steps = 8, .gravity = false});
    REQUIRE(path.converged);
    CHECK(path.message.empty());
    check_factors(path, {0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1});
    for (const EquilibriumPathPoint& point : path.points) {
        CAPTURE(point.factor);
        CHECK(point.at.q(0) == Approx(std::asin(point.factor * 0.95)).margin(1e-10));
        CHECK(point.negative_pivots == 0);
        CHECK(point.residual < 1e-8);
        CHECK(point.iterations < 10);
    }
    CHECK_FALSE(path.stability_change);
    CHECK(path.failed_steps == 0);
}

TEST_CASE("load path: gravity grows with the loads or acts in full from the start", "[analytic]") {
    const double k = 7, H = 12;
    const System system = Pendulum{.k = k, .force = {-H, 0, 0}}.system();
    for (const bool gravity : {true, false}) {
        const EquilibriumPath path = equilibrium_path(system, {.factors = {0, 0.3, 1, 2.5}, .gravity = gravity});
        REQUIRE(path.converged);
        check_factors(path, {0, 0.3, 1, 2.5});
        for (const EquilibriumPathPoint& point : path.points) {
            const double weight = gravity ? point.factor * m * g : m * g;
            const double expected = bisect(
                [&](double q) {
                    return k * q + weight * length * std::sin(q) - point.factor * H * length * std::cos(q);
                },
                -0.1, 2);
            CHECK(point.at.q(0) == Approx(expected).margin(1e-10));
        }
    }
}

TEST_CASE("load path: a follower force turns the pendulum without limit, k q = F l", "[analytic]") {
    const System system = Pendulum{.k = 2, .force = {-8, 0, 0}, .axes = WrenchAxes::frame, .gravity = 0}.system();
    const EquilibriumPath path = equilibrium_path(system, {.steps = 4});
    REQUIRE(path.converged);
    for (const EquilibriumPathPoint& point : path.points)
        CHECK(point.at.q(0) == Approx(point.factor * 8 * length / 2).margin(1e-10));
}

TEST_CASE("load path: an inverted pendulum loses stability at P l = k and is followed beyond", "[analytic]") {
    const double k = 20, critical = k / length;
    const System system = Pendulum{.k = k, .side = 1, .force = {0, 0, -1}, .gravity = 0}.system();
    EquilibriumPathOptions options{.factors = {0, 0.4 * critical, 0.8 * critical, 1.2 * critical, 2 * critical}};
    const EquilibriumPath coarse = equilibrium_path(system, options);
    REQUIRE(coarse.converged);
    REQUIRE(coarse.stability_change);
    CHECK(coarse.stability_change->before == 0.8 * critical);
    CHECK(coarse.stability_change->after == 1.2 * critical);
    options.stability_tolerance = 1e-10;
    const EquilibriumPath fine = equilibrium_path(system, options);
    REQUIRE(fine.stability_change);
    CHECK(fine.stability_change->factor() == Approx(critical).epsilon(1e-10));
    CHECK(fine.stability_change->after - fine.stability_change->before <= 1e-10);
    CHECK(fine.stability_change->negative_pivots_before == 0);
    CHECK(fine.stability_change->negative_pivots_after == 1);
    CHECK(fine.points.size() == 5);
    CHECK(fine.points.back().negative_pivots == 1);
    CHECK(fine.points.back().at.q(0) == Approx(0).margin(1e-12));
    // At the critical load itself spring and load cancel; the straight bar is an equilibrium none the less.
    CHECK(equilibrium_path(system, {.factors = {0, critical, 2 * critical}}).converged);
}

TEST_CASE("load path: an imperfect inverted pendulum leans over without losing stability", "[analytic]") {
    // k q = P l (sin q + e cos q) with a side force e P.
    const double k = 20, e = 0.01, P = 1.5 * k / length;
    const System system = Pendulum{.k = k, .side = 1, .force = {e * P, 0, -P}, .gravity = 0}.system();
    const EquilibriumPath path = equilibrium_path(system, {.steps = 30});
    REQUIRE(path.converged);
    CHECK_FALSE(path.stability_change);
    const double expected =
        bisect([&](double q) { return k * q - P * length * (std::sin(q) + e * std::cos(q)); }, 0.5, 2.5);
    CHECK(path.points.back().at.q(0) == Approx(expected).epsilon(1e-9));
}

TEST_CASE("load path: beyond a limit load it ends with the last state, the factor and the reason", "[analytic]") {
    const double limit = m * g * length;
    const System system = Pendulum{.moment = 1.25 * limit}.system();  // limit at load factor 0.8
    const EquilibriumPath path = equilibrium_path(system, {.smallest_step = 1e-6, .gravity = false});
    CHECK_FALSE(path.converged);
    CHECK(path.failed_steps > 3);
    REQUIRE(path.points.size() > 8);
    const EquilibriumPathPoint& last = path.points.back();
    CHECK(last.factor == Approx(0.8).margin(2e-6));
    CHECK(last.factor <= 0.8 + 1e-9);
    CHECK(last.at.q(0) == Approx(std::asin(1.25 * last.factor)).margin(1e-4));
    for (std::size_t i = 1; i < path.points.size(); ++i) CHECK(path.points[i].factor > path.points[i - 1].factor);
    for (const char* part : {"load path ended at load factor 0.", "steady state not found", "smallest_step", "limit",
                             "last converged state is kept"}) {
        CAPTURE(path.message, part);
        CHECK(contains(path.message, part));
    }
}

TEST_CASE("load path: a step that fails is not halved below the smallest one", "[analytic]") {
    const System system = Pendulum{.moment = 50 * m * g * length}.system();
    const EquilibriumPath path = equilibrium_path(system, {.steps = 1, .smallest_step = 0.6, .gravity = false});
    CHECK_FALSE(path.converged);
    CHECK(path.failed_steps == 1);
    check_factors(path, {0});
    CHECK(contains(path.message, "ended at load factor 0, the step to 1 failed"));
}

TEST_CASE("load path: too few iterations for one step are made up by halving", "[analytic]") {
    const double M = 0.9 * m * g * length;
    EquilibriumPathOptions options{.steps = 1, .gravity = false};
    options.state.iterations = 3;
    const EquilibriumPath path = equilibrium_path(Pendulum{.moment = M}.system(), options);
    REQUIRE(path.converged);
    CHECK(path.failed_steps > 0);
    CHECK(path.points.back().factor == 1);
    CHECK(path.points.back().at.q(0) == Approx(std::asin(0.9)).epsilon(1e-9));
}

TEST_CASE("load path: a jump to a distant equilibrium is refused if its size is limited", "[analytic]") {
    // An inverted pendulum on a weak spring pushed through: it leans one way and the force turns round.
    const double k = 20, P = 1.2 * k / length;
    const System system = Pendulum{.k = k, .side = 1, .force = {-0.6 * P, 0, 0}, .gravity = P / m}.system();
    EquilibriumPathOptions options{.steps = 40, .smallest_step = 1e-4, .gravity = false};
    options.state.initial = Vector::Constant(1, 1);
    options.largest_change = 0.5;
    const EquilibriumPath path = equilibrium_path(system, options);
    CHECK_FALSE(path.converged);
    // Limit point of k q = P l (sin q - 0.6 f cos q): stiffness zero.
    const double q = bisect(
        [&](double x) {
            const double f = (std::sin(x) - k * x / (P * length)) / (0.6 * std::cos(x));
            return k - P * length * (std::cos(x) + 0.6 * f * std::sin(x));
        },
        0.3, 1);
    const double limit = (std::sin(q) - k * q / (P * length)) / (0.6 * std::cos(q));
    REQUIRE(limit > 0.1);
    REQUIRE(limit < 1);
    CHECK(path.points.back().factor == Approx(limit).margin(2e-4));
    CHECK(path.points.back().at.q(0) == Approx(q).margin(0.05));
    CHECK(path.points.back().at.q(0) > q - 1e-3);
    CAPTURE(path.message);
    CHECK(contains(path.message, "limit"));
}

TEST_CASE("load path in steady rotation: the rotor speed stays, the loads grow", "[analytic]") {
    // A bar hinged beside the spin axis z flaps along z under a force along z at its end.
    const double bar = 2, offset = 0.5, k = 30, mass = 1.5, force = 40, Omega = 3;
    Tree tree;
    ForceSet forces;
    const Link spin = add_joint(tree, {.name = "spin", .inertia = {2, Vec3::Zero(), Mat3::Identity()}});
    const FrameId hinge = tree.add_frame(spin.axes, Placement::translation({offset, 0, 0}), "hinge");
    const Link flap =
        add_joint(tree, {.name = "flap", .inboard = hinge, .axis = -Vec3::UnitY(), .inertia = {mass, {bar, 0, 0}}});
    const FrameId tip = tree.add_frame(flap.axes, Placement::translation({bar, 0, 0}), "tip");
    forces.add_spring("flap spring", flap.body, k);
    forces.add_wrench({"thrust", tip, {{0, 0, force}, Vec3::Zero()}, WrenchAxes::base});
    const System system(tree, forces);
    const EquilibriumPath path =
        equilibrium_path(system, {.steps = 5, .spin = 0, .state = {.rotor_speed = Omega, .azimuth = 0.4}});
    REQUIRE(path.converged);
    for (const EquilibriumPathPoint& point : path.points) {
        const double expected = bisect(
            [&](double q) {
                return k * q + mass * Omega * Omega * (offset + bar * std::cos(q)) * bar * std::sin(q) -
                       point.factor * force * bar * std::cos(q);
            },
            -0.1, 1.5);
        CHECK(point.at.q(1) == Approx(expected).margin(1e-10));
        CHECK(point.at.q(0) == 0.4);
        CHECK(point.at.qd(0) == Omega);
        CHECK(point.negative_pivots == 0);
    }
    // Gravity across the axis makes the state periodic as soon as it acts.
    ForceSet heavy = forces;
    heavy.set_gravity({0, -g, 0});
    const EquilibriumPath periodic =
        equilibrium_path(System(tree, heavy), {.steps = 5, .spin = 0, .state = {.rotor_speed = Omega}});
    CHECK_FALSE(periodic.converged);
    check_factors(periodic, {0});
    CHECK(contains(periodic.message, "no constant steady state"));
}

TEST_CASE("load factor: wrenches, user forces and, if wanted, gravity are multiplied, springs stay", "[property]") {
    Tree tree;
    ForceSet set;
    const Link a = add_joint(tree, {.name = "a", .axis = Vec3::UnitY(), .inertia = {1, {0.5, 0, 0.2}}});
    const FrameId elbow = tree.add_frame(a.axes, Placement::translation({1, 0, 0}), "elbow");
    const Link b = add_joint(tree, {.name = "b", .inboard = elbow, .axis = Vec3::UnitZ(), .inertia = {2, {1, 0, 0}}});
    set.add_spring("spring", a.body, 3, 0.4, 0.1);
    set.add_wrench({"dead", b.axes, {{1, 2, 3}, Vec3::Zero()}, WrenchAxes::base});
    set.add_wrench({"follower", b.axes, {{-1, 0, 2}, {0.3, 0.1, 0}}, WrenchAxes::frame});
    set.set_gravity({0, 1, -9});
    const auto force = [](const ElementView& at, ElementForces& out) {
        out.Q(0) += std::sin(at.q(1)) - at.qd(0);
        out.Q(1) += at.q(0) * at.q(1);
    };
    set.add_element({.name = "differenced",
                     .coordinates = {a.body, b.body},
                     .evaluate = force,
                     .potential = [](const ElementView& at) { return at.q(0); }});
    set.add_element({.name = "exact",
                     .coordinates = {a.body, b.body},
                     .evaluate = force,
                     .jacobian = [](const ElementView& at, ElementJacobian& d) {
                         d.Q_q(0, 1) = std::cos(at.q(1));
                         d.Q_q(1, 0) = at.q(1);
                         d.Q_q(1, 1) = at.q(0);
                         d.Q_qd(0, 0) = -1;
                     }});
    const System system(tree, set);
    const Vector q = (Vector(2) << 0.7, -0.4).finished(), qd = (Vector(2) << 0.2, 0.5).finished();
    Workspace workspace(system.model);
    const Kinematics kin = kinematics(system.model, q, workspace);
    struct Result {
        Vector Q = Vector::Zero(2);
        ForceDerivatives by;
        double energy = 0;
    };
    const auto evaluate = [&](const Forces& forces) {
        Result r;
        forces.generalised_forces({{.q = q, .qd = qd}, kin}, r.Q);
        forces.derivatives({{.q = q, .qd = qd}, kin}, r.by);
        r.energy = forces.potential_energy({{.q = q, .qd = qd}, kin});
        return r;
    };
    for (const bool gravity : {true, false}) {
        const Result none = evaluate(system.forces.with_load_factor(0, gravity)), full = evaluate(system.forces);
        for (const double factor : {2.5, -0.3, 1.0}) {
            const Result some = evaluate(system.forces.with_load_factor(factor, gravity));
            CHECK((some.Q - none.Q - factor * (full.Q - none.Q)).norm() < 1e-13);
            CHECK((some.by.elastic - full.by.elastic).norm() == 0);
            CHECK((some.by.loads - factor * full.by.loads).norm() < 1e-8);
            CHECK((some.by.gravity - (gravity ? factor : 1) * full.by.gravity).norm() < 1e-13);
            CHECK((some.by.damping - none.by.damping - factor * (full.by.damping - none.by.damping)).norm() < 1e-8);
            CHECK(some.energy - none.energy == Approx(factor * (full.energy - none.energy)));
        }
        const Result twice = evaluate(system.forces.with_load_factor(2, gravity).with_load_factor(3, gravity));
        CHECK((twice.Q - evaluate(system.forces.with_load_factor(6, gravity)).Q).norm() < 1e-12);
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    check_refused([&] { (void)system.forces.with_load_factor(nan, true); }, {"load factor = nan", "finite"});
}

TEST_CASE("load path: factors that are not finite or not increasing, and bad steps, are refused", "[property]") {
    const System system = Pendulum{.k = 1}.system();
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    check_refused([&] { (void)equilibrium_path(system, {.factors = {0, nan, 1}}); }, {"load factor 2 = nan", "finite"});
    check_refused([&] { (void)equilibrium_path(system, {.factors = {0, 1, inf}}); }, {"load factor 3 = inf", "finite"});
    check_refused(
        [&] {
            (void)equilibrium_path(system, {.factors = {0, 0.5, 0.5}});
        },
        {"load factor 3 = 0.5", "> 0.5", "strictly increasing"});
    check_refused(
        [&] {
            (void)equilibrium_path(system, {.factors = {1, 0}});
        },
        {"load factor 2 = 0", "strictly increasing"});
    check_refused([&] { (void)equilibrium_path(system, {.steps = 0}); }, {"number of steps = 0", ">= 1"});
    check_refused([&] { (void)equilibrium_path(system, {.smallest_step = 0}); }, {"smallest step", "> 0"});
    check_refused([&] { (void)equilibrium_path(system, {.smallest_step = nan}); }, {"smallest step", "nan"});
    check_refused([&] { (void)equilibrium_path(system, {.largest_change = -1}); }, {"largest change", "> 0"});
    check_refused([&] { (void)equilibrium_path(system, {.stability_tolerance = -1}); }, {"loss of stability", ">= 0"});
    check_refused([&] { (void)equilibrium_path(system, {.state = {.rotor_speed = 2}}); }, {"without rotor"});
}

TEST_CASE("load path: no state at the first factor is reported without points", "[analytic]") {
    const EquilibriumPath path =
        equilibrium_path(Pendulum{.moment = 3 * m * g * length}.system(), {.factors = {1, 2}, .gravity = false});
    CHECK_FALSE(path.converged);
    CHECK(path.points.empty());
    CHECK(contains(path.message, "no state at the first load factor 1"));
}

TEST_CASE("negative pivots are counted on the symmetric part, whatever the units", "[analytic]") {
    Matrix K(3, 3);
    K << 2, -1, 0, -1, -3, 0, 0, 0, 1e-8;
    CHECK(negative_pivots(K) == 1);
    K(2, 2) = -1e-8;
    CHECK(negative_pivots(K) == 2);
    K << 1, 3, 0, -3, 1, 0, 0, 0, 0;
    CHECK(negative_pivots(K) == 0);
    CHECK(negative_pivots(Matrix(0, 0)) == 0);
}

}  // namespace cardan::testing::load_paths
