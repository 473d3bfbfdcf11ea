// Equilibria and small oscillations of mechanisms with loops.
#include "elements/machine_elements/point_spring.hpp"
#include "solvers/equilibrium/buckling.hpp"
#include "solvers/equilibrium/equilibrium_path.hpp"
#include "solvers/equilibrium/load_curve.hpp"
#include "solvers/equilibrium/load_stability.hpp"
#include "solvers/equilibrium/natural_modes.hpp"
#include "solvers/linear/loop_reduction.hpp"
#include "tests/mbs/loops/closed_trees.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace loop_equilibrium_tests {

// A blade that turns by phi about x, with a pin, pitched by an actuator that moves by z along a line inclined by 6
// degrees, and a push rod between them.
struct PitchLinkage {
    static constexpr double r = 0.9, ex = 0.15, ey = 0.75, H = 1.6, length = 1.9160983729226821;
    static constexpr double rod_stiffness = 2e8, actuator_stiffness = 6e7;  // N/m

    /// @param z  stroke; driven, or where the actuator's spring rests
    PitchLinkage(bool rigid, double z, double moment, double inertia = 100) : system(make(rigid, z, moment, inertia)) {}
    static System make(bool rigid, double z, double moment, double inertia) {
        const double a0 = 20 * pi / 180, tilt = 6 * pi / 180;
        Tree tree;
        const Link blade = add_joint(
            tree, {.name = "phi", .axis = Vec3::UnitX(), .inertia = {1, Vec3::Zero(), inertia * Mat3::Identity()}});
        const FrameId P =
            tree.add_frame(blade.axes, Placement::translation({ex, r * std::cos(a0), r * std::sin(a0)}), "P");
        const FrameId foot = tree.add_frame(Tree::base(), Placement::translation({0, ey, -H}), "foot");
        const Link Q = add_joint(tree, {.name = "z",
                                        .inboard = foot,
                                        .kind = JointKind::prismatic,
                                        .axis = Vec3(std::sin(tilt), 0, std::cos(tilt)),
                                        .inertia = {1e-6, Vec3::Zero(), Mat3::Zero()},
                                        .role = rigid ? CoordinateRole::prescribed : CoordinateRole::free});
        ForceSet forces;
        forces.add_wrench({.name = "moment", .frame = blade.axes, .wrench = {Vec3::Zero(), Vec3(moment, 0, 0)}});
        LoopSet loops;
        if (rigid) {
            loops.add_distance({"push rod", Q.axes, P, length});
        } else {
            add_point_spring(forces,
                             {.name = "push rod", .a = Q.axes, .b = P, .stiffness = rod_stiffness, .length = length});
            forces.add_spring("actuator", Q.body, actuator_stiffness, 0, z);
        }
        return {tree, forces, loops};
    }

    System system;
};

}  // namespace loop_equilibrium_tests

using namespace loop_equilibrium_tests;

TEST_CASE("loop equilibria: a four-bar that hangs, and swings", "[discrete]") {
    for (const CutKind kind : {CutKind::cylindrical, CutKind::revolute}) {
        CAPTURE(static_cast<int>(kind));
        const FourBar machine(CoordinateRole::free, kind);
        const System& system = machine.system;
        const SteadyState state = steady_state(system, -1, {.initial = FourBar::position(-1.6, 0.9, 2.2)});
        REQUIRE(state.converged);
        CHECK(state.at.q(0) == Approx(-1.8250467689).epsilon(1e-9));
        const Linearisation lin = linearise(system, state.at);
        const ReducedSystem reduced = reduce_loops(lin, {0, 1, 2});
        CHECK(reduced.system.M.rows() == 1);
        CHECK(max_abs(lin.constraints * reduced.shape) < 1e-12);
        const std::vector<Mode> found = modes(reduced.system);
        REQUIRE(found.size() == 1);
        CHECK(found[0].eigenvalue.imag() == Approx(15.7425669).epsilon(1e-8));
        CHECK(std::abs(found[0].eigenvalue.real()) < 1e-6);
        const NaturalModes natural = natural_modes(system, -1, 0, FourBar::position(-1.6, 0.9, 2.2));
        CHECK(natural.modes.at(0).eigenvalue.imag() == Approx(15.7425669).epsilon(1e-8));
        // What knows trees only says so.
        check_refused([&] { (void)restrict_to(lin, {0, 1, 2}); }, {"loops", "reduce_loops"});
        check_refused([&] { (void)linear_buckling(system); }, {"linear buckling", "pin B"});
    }
}

TEST_CASE("loop equilibria: Bricard's loop at its lowest position", "[discrete]") {
    const Bricard machine;
    const System& system = machine.system;
    // Joint angles q, p, q, p, q with sin p = -sin q / (1 + sin q); the lowest position is a quarter turn away.
    const double q = 1.5, p = std::asin(-std::sin(q) / (1 + std::sin(q)));
    Vector near(5);
    near << q, p, q, p, q;
    SteadyState state = steady_state(system, -1, {.initial = near});
    if (!state.converged) state = steady_state(system, -1, {.initial = -near});
    REQUIRE(state.converged);
    Workspace workspace(system.model);
    const Vec3 P2 = pose(kinematics(system.model, state.at.q, workspace), system.model.frame("P2")).p;
    CHECK((P2 - Vec3(0, -std::sqrt(3) / 2, -0.5)).norm() < 1e-8);
    const std::vector<Mode> found = modes(reduce_loops(linearise(system, state.at), {0, 1, 2, 3, 4}).system);
    REQUIRE(found.size() == 1);
    CHECK(found[0].eigenvalue.imag() == Approx(1.2412987).epsilon(1e-6));
}

TEST_CASE("loop equilibria: natural modes of a closed machine are those of the open one that it equals", "[analytic]") {
    // A mass on a rod about the origin, held by springs in x and y: against the same mass on a hinge.
    const double length = 1.3, m = 2, kx = 30, ky = 70;
    Tree tree;
    const auto [x, y] = add_plane_mass(tree, m);
    ForceSet forces;
    forces.add_spring("x", x.body, kx, 0, length);  // at rest on the x axis
    forces.add_spring("y", y.body, ky, 0, 0);
    forces.add_wrench({.name = "pull", .frame = y.axes, .wrench = {Vec3(5, 0, 0), Vec3::Zero()}});
    LoopSet loops;
    loops.add_distance({"rod", Tree::base(), y.axes, length});
    const System system(tree, forces, loops);
    const SteadyState state = steady_state(system, -1, {.initial = Vector{{1.2, 0.3}}});
    REQUIRE(state.converged);
    CHECK(state.at.q(0) == Approx(length));
    CHECK(std::abs(state.at.q(1)) < 1e-9);
    CHECK(state.at.lambda(0) == Approx(-5));  // the rod is in tension
    const ReducedSystem reduced = reduce_loops(linearise(system, state.at), {0, 1});
    CHECK(reduced.system.coordinates == std::vector<int>{1});
    // m l^2 phi'' + (ky l^2 + 5 l) phi = 0
    CHECK(modes(reduced.system).at(0).eigenvalue.imag() == Approx(std::sqrt((ky + 5 / length) / m)).epsilon(1e-9));
    check_refused(
        [&] {
            DynamicState moving = state.at;
            moving.qd = Vector{{0, 1.0}};
            (void)linearise(system, moving);
        },
        {"'y'", "rate", "motion"});
    check_refused(
        [&] {
            DynamicState open = state.at;
            open.q(0) = 2;
            (void)linearise(system, open);
        },
        {"rod", "gap"});
}

TEST_CASE("loop equilibria: a mass upright on a rod, in a loop, falls at the load of its spring", "[analytic]") {
    // On slides in x and y, held sideways by k: m l^2 phi'' + (k l^2 - F l) phi = 0.
    const double length = 1.3, k = 30, full = 100;
    Tree tree;
    const auto [x, y] = add_plane_mass(tree, 2);
    ForceSet forces;
    forces.add_spring("side", x.body, k, 0.5);
    forces.add_wrench({.name = "load", .frame = y.axes, .wrench = {Vec3(0, -full, 0), Vec3::Zero()}});
    LoopSet loops;
    loops.add_distance({"rod", Tree::base(), y.axes, length});
    const System system(tree, forces, loops);
    const LoadStability found =
        load_stability(system, {.from = 0.01, .to = 1, .steps = 10, .state = {.initial = Vector{{0, length}}}});
    REQUIRE(found.converged);
    CHECK(found.kind == Instability::divergence);
    CHECK(found.factor * full == Approx(k * length).epsilon(1e-6));
}

TEST_CASE("loop equilibria: two wheels held by a spring and tied by a coupling only", "[analytic]") {
    // Pinion = -2 wheel; a torque M on the pinion, a spring k on the wheel: k wheel = -2 M.
    Tree tree;
    const Link wheel = add_joint(tree, {.name = "wheel", .inertia = {1, Vec3::Zero(), Mat3::Identity()}});
    const Link pinion = add_joint(tree, {.name = "pinion", .inertia = {1, Vec3::Zero(), Mat3::Identity()}});
    ForceSet forces;
    forces.add_spring("spring", wheel.body, 50, 0);
    forces.add_wrench({.name = "torque", .frame = pinion.axes, .wrench = {Vec3::Zero(), Vec3(0, 0, 3)}});
    LoopSet loops;
    loops.add_coupling({"gear", {{wheel.body, 2.0}, {pinion.body, 1.0}}, 0, "rad"});
    const System system(tree, forces, loops);
    const SteadyState state = steady_state(system, -1, {});
    REQUIRE(state.converged);
    CHECK(state.at.q(0) == Approx(-6.0 / 50));
    CHECK(state.at.q(1) == Approx(12.0 / 50));
    check_refused(
        [&] {
            DynamicState open = state.at;
            open.q(0) = 1;
            (void)linearise(system, open);
        },
        {"gear", "wheel", "pinion", "gap"});
}

TEST_CASE("loop equilibria: a blade pitched by crank and push rod", "[discrete]") {
    struct Row {
        double z, phi, slope, stiffness, tension, loaded;
    };
    const std::vector<Row> rows = {{0, 0, 1.2077151796, 31619784.80, 120964.205, 0.00316791},
                                   {0.1, 0.123647690355, 1.2680758511, 28690893.94, 126917.229, 0.12714095},
                                   {0.3, 0.393845812648, 1.4494350247, 21949240.96, 145226.011, 0.39841934},
                                   {0.5, 0.711753552035, 1.7586724953, 14820161.11, 178475.959, 0.71854912},
                                   {0.7, 1.116506009053, 2.3748178057, 7933027.22, 253216.471, 1.12934223},
                                   {0.9, 1.796441639572, 6.5777426247, 913537.14, 864331.660, 0}};
    const double M = 1e5;
    for (const Row& row : rows) {
        CAPTURE(row.z);
        const PitchLinkage rigid(true, row.z, M);
        const System& system = rigid.system;
        const Vector near{{row.phi - 0.02, row.z}};
        const SteadyState state = steady_state(system, -1, {.initial = near});
        REQUIRE(state.converged);
        CHECK(state.at.q(0) == Approx(row.phi).margin(1e-10));
        CHECK(-state.at.lambda(0) == Approx(row.tension).epsilon(1e-8));
        Matrix G(1, 2);
        Workspace workspace(system.model);
        system.loops.gradient<double>(kinematics(system.model, state.at.q, workspace), 0, state.at.q, G);
        CHECK(-G(0, 1) / G(0, 0) == Approx(row.slope).epsilon(1e-9));

        // The rod and the actuator as springs: the blade's stiffness from the frequency with which it swings.
        const double J = 1e3;
        const PitchLinkage unloaded(false, row.z, 0, J);
        const SteadyState at_rest = steady_state(unloaded.system, -1, {.initial = Vector{{row.phi, row.z}}});
        REQUIRE(at_rest.converged);
        const double w = modes(restrict_to(linearise(unloaded.system, at_rest.at), {0, 1})).at(0).eigenvalue.imag();
        CHECK(J * w * w == Approx(row.stiffness).epsilon(1e-7));
        if (row.loaded == 0) continue;
        const PitchLinkage loaded(false, row.z, M);
        const SteadyState bent = steady_state(loaded.system, -1, {.initial = Vector{{row.phi, row.z}}});
        REQUIRE(bent.converged);
        CHECK(bent.at.q(0) == Approx(row.loaded).margin(1e-8));
    }
}

TEST_CASE("loop equilibria: near its dead point the pitch linkage has a limit load", "[discrete]") {
    const PitchLinkage linkage(false, 0.9, 1e4);
    EquilibriumPathOptions options;
    options.state.initial = Vector{{1.796441639572, 0.9}};
    options.factors = {0, 1, 2, 3, 4, 4.5, 5};
    options.largest_change = 0.1;
    options.smallest_step = 1e-6;
    const EquilibriumPath path = equilibrium_path(linkage.system, options);
    CHECK_FALSE(path.converged);  // load control ends at the limit
    CHECK(path.points.back().factor * 1e4 == Approx(47076.0).epsilon(1e-5));
    CHECK(path.points.back().at.q(0) == Approx(1.906609).margin(1e-3));  // a root there: half the digits
    const auto bent = [](double moment, double near) {
        const PitchLinkage one(false, 0.9, moment);
        const SteadyState state = steady_state(one.system, -1, {.initial = Vector{{near, 0.9}}});
        REQUIRE(state.converged);
        return state.at.q(0);
    };
    CHECK(bent(2e4, 1.82) == Approx(1.821681431).margin(1e-8));
    CHECK(bent(4e4, 1.86) == Approx(1.861930431).margin(1e-8));
    CHECK(bent(1e5, 2.33) == Approx(2.33623656).margin(1e-7));
}

TEST_CASE("loop equilibria: the pitch linkage snaps through along its load curve", "[discrete]") {
    const PitchLinkage linkage(false, 0.9, 1e5);
    LoadCurveOptions options;
    options.state.initial = Vector{{1.796441639572, 0.9}};
    const LoadCurve curve = load_curve(linkage.system, options);
    REQUIRE(curve.converged);
    REQUIRE(curve.limits.size() == 2);  // up to the limit, back, and up again behind it
    CHECK(curve.limits[0].factor * 1e5 == Approx(47076.0).epsilon(1e-6));
    CHECK(curve.limits[0].at.q(0) == Approx(1.906609).margin(1e-6));
    CHECK(curve.points.front().negative_pivots == 0);
    CHECK(curve.points.back().negative_pivots == 0);
    int unstable = 0;
    for (const LoadCurvePoint& point : curve.points) unstable = std::max(unstable, point.negative_pivots);
    CHECK(unstable == 1);
    // The equilibrium under the whole load, from the end of the curve.
    const SteadyState behind = steady_state(linkage.system, -1, {.initial = curve.points.back().at.q});
    REQUIRE(behind.converged);
    CHECK(behind.at.q(0) == Approx(2.33623656).margin(1e-7));
}

TEST_CASE("loop equilibria: a toggle of two bars and a spring has its limit in closed form", "[analytic]") {
    // Bars of 1 m from (0, 0), hinged in the middle, to a slider on x that a spring of 1000 N/m holds at x = 1.8: a
    // loop. A load F down at the hinge at angle t: x = 2 cos t, F = 2 k (2 cos t - 1.8) tan t ... with its sign.
    const double k = 1000, rest = 1.8;
    Tree tree;
    const Bar left = add_bar(tree, "left", Tree::base(), 1, bar_along_x(1, 1));
    const Bar right = add_bar(tree, "right", left.end, 1, bar_along_x(1, 1));
    const Link slider = add_joint(tree, {.name = "slider",
                                         .kind = JointKind::prismatic,
                                         .axis = Vec3::UnitX(),
                                         .inertia = {1, Vec3::Zero(), Mat3::Zero()}});
    ForceSet forces;
    forces.add_spring("spring", slider.body, k, 0, rest);
    forces.add_wrench({.name = "load", .frame = left.end, .wrench = {Vec3(0, -100, 0), Vec3::Zero()}});
    LoopSet loops;
    loops.add_joint({"pin", CutKind::revolute, right.end, slider.axes});
    const System system(tree, forces, loops);
    const double t0 = std::acos(rest / 2);
    LoadCurveOptions options;
    options.state.initial = Vec3(t0, -2 * t0, rest);
    options.to = 3;
    const LoadCurve curve = load_curve(system, options);
    REQUIRE(curve.converged);
    // Energy k/2 (2 cos t - rest)^2, the hinge at sin t: F cos t = 2 k (2 cos t - rest) sin t.
    const auto load = [&](double t) { return 2 * k * (2 * std::cos(t) - rest) * std::tan(t); };
    for (const LoadCurvePoint& point : curve.points)
        CHECK(100 * point.factor == Approx(load(point.at.q(0))).margin(1e-6));
    // dF/dt = 0: 2 cos^3 t = rest.
    const double t_limit = std::acos(std::cbrt(rest / 2));
    REQUIRE(curve.limits.size() == 2);
    CHECK(curve.limits[0].at.q(0) == Approx(t_limit).margin(1e-8));
    CHECK(100 * curve.limits[0].factor == Approx(load(t_limit)).epsilon(1e-12));
    CHECK(curve.limits[1].at.q(0) == Approx(-t_limit).margin(1e-8));
    CHECK(curve.points.front().negative_pivots == 0);
    // Under load control the path ends there.
    EquilibriumPathOptions controlled;
    controlled.state.initial = options.state.initial;
    controlled.factors = {0, 0.1, 3};
    controlled.largest_change = 0.1;
    const EquilibriumPath path = equilibrium_path(system, controlled);
    CHECK_FALSE(path.converged);
    CHECK(100 * path.points.back().factor == Approx(load(t_limit)).epsilon(1e-3));
    check_refused([&] { (void)load_curve(system, {.from = 1, .to = 1}); }, {"load factors"});
    check_refused([&] { (void)load_curve(system, {.first_step = 0}); }, {"first step"});
}

TEST_CASE("loop equilibria: a loop that cannot be closed is told", "[bad-input]") {
    // A bar of a metre, and a pin three metres away.
    Tree tree;
    const Bar one = add_bar(tree, "one", Tree::base(), 1, bar_along_x(1, 1));
    LoopSet far;
    far.add_joint(
        {"pin", CutKind::spherical, one.end, tree.add_frame(Tree::base(), Placement::translation({3, 0, 0}), "C")});
    const System apart(tree, {}, far);
    try {
        (void)steady_state(apart, -1, {});
        FAIL("closed");
    } catch (const NumericalError& error) {
        CHECK(contains(error.what(), "'pin'"));
        CHECK(contains(error.what(), "cannot be closed"));
    }
}
