// Equilibrium at standstill and in steady rotation against force balances by hand.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/oracles/root_finding.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/little_memory.hpp"
#include "tests/support/point_masses.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/tree_tools.hpp"

#include <Eigen/Geometry>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;
using cardan::oracles::bisect;

namespace {

// A bar with a point mass at its end, hinged with a spring at a distance from the spin axis z; it flaps along z.
struct HingedBar {
    double m = 1.5, length = 2, offset = 0.5, k = 30, rest = 0.3;
    Vec3 gravity = Vec3::Zero();

    System system() const {
        Tree tree;
        ForceSet forces;
        const Link spin = add_joint(tree, {.name = "spin", .inertia = {2, Vec3::Zero(), Mat3::Identity()}});
        const FrameId hinge = tree.add_frame(spin.axes, Placement::translation({offset, 0, 0}), "hinge");
        const Link flap = add_joint(
            tree, {.name = "flap", .inboard = hinge, .axis = -Vec3::UnitY(), .inertia = point_mass(m, {length, 0, 0})});
        forces.add_spring("flap spring", flap.body, k, 0, rest);
        forces.set_gravity(gravity);
        return System(tree, forces);
    }
    // Moments about the hinge: spring, centrifugal force on the arm length sin(flap), weight along -z.
    double balance(double flap, double Omega) const {
        return k * (flap - rest) + m * Omega * Omega * (offset + length * std::cos(flap)) * length * std::sin(flap) -
               m * gravity.z() * length * std::cos(flap);
    }
};

// A pendulum that turns about y under gravity along -z, with a spring and a moment on it.
System pendulum(double k, double moment, double m = 2, double length = 1.5, bool upside_down = false) {
    Tree tree;
    ForceSet forces;
    const Link link = add_joint(
        tree,
        {.name = "hinge", .axis = Vec3::UnitY(), .inertia = point_mass(m, {0, 0, upside_down ? length : -length})});
    if (k > 0) forces.add_spring("spring", link.body, k);
    forces.set_gravity({0, 0, -units::standard_gravity});
    forces.add_wrench({"moment", link.axes, {Vec3::Zero(), {0, moment, 0}}, WrenchAxes::base});
    return System(tree, forces);
}

// A rotor with an eccentric mass about z on a spring along x.
System eccentric_rotor(double eccentricity) {
    Tree tree;
    ForceSet forces;
    const Link support = add_joint(
        tree, {.name = "support", .kind = JointKind::prismatic, .axis = Vec3::UnitX(), .inertia = {1, Vec3::Zero()}});
    add_joint(tree, {.name = "spin",
                     .inboard = support.axes,
                     .inertia = {3, {eccentricity, 0, 0}, Vec3(0.1, 0.1, 0.2).asDiagonal()}});
    forces.add_spring("support", support.body, 500);
    return System(tree, forces);
}

template <class Call>
std::string numerical_error(Call&& call) {
    try {
        call();
    } catch (const NumericalError& error) {
        return error.what();
    }
    return "(nothing thrown)";
}

}  // namespace

TEST_CASE("steady state: a spinning hinged bar takes the angle where spring and centrifugal moment balance",
          "[analytic]") {
    const HingedBar bar;
    const System system = bar.system();
    for (const double Omega : {0.0, 0.5, 3.0, -3.0, 20.0}) {
        CAPTURE(Omega);
        const SteadyState state = steady_state(system, 0, {.rotor_speed = Omega, .azimuth = 0.7});
        const double expected = bisect([&](double flap) { return bar.balance(flap, Omega); }, -1, 1);
        REQUIRE(state.converged);
        CHECK(state.message.empty());
        CHECK(state.residual < 1e-8);
        CHECK(state.at.q(1) == Approx(expected).margin(1e-11));
        CHECK(state.at.q(0) == 0.7);
        CHECK(state.at.qd(0) == Omega);
        CHECK(state.at.qd(1) == 0);
        CHECK(state.at.qdd.isZero(0));
    }
}

TEST_CASE("steady state: gravity along the rotor axis leaves a constant state (centrifugal governor)", "[analytic]") {
    HingedBar bar;
    bar.gravity = {0, 0, -units::standard_gravity};
    bar.rest = 0;
    const SteadyState state = steady_state(bar.system(), 0, {.rotor_speed = 4});
    const double expected = bisect([&](double flap) { return bar.balance(flap, 4); }, -1.5, 1);
    REQUIRE(state.converged);
    CHECK(expected < -0.1);
    CHECK(state.at.q(1) == Approx(expected).margin(1e-11));
}

TEST_CASE("steady state: in a coned rotating beam every joint carries the centrifugal forces of the bodies outboard",
          "[property]") {
    // d'Alembert: Q_a + axis . sum over bodies outboard of [(c - o) x m Omega^2 rho - omega x J omega] = 0.
    const double Omega = 6, cone = 0.15;
    Tree tree;
    ForceSet forces;
    const Link spin = add_joint(tree, {.name = "spin", .inertia = {2, Vec3::Zero(), Mat3::Identity()}});
    const FrameId root = tree.add_frame(spin.axes, {rot_y(-cone), {0.4, 0, 0}}, "blade root");
    EngineeringSection section = slender(800, 3);
    section.mass_centre.y = -0.05;
    const CardanBeam beam =
        add_cardan_beam(tree, forces, root, uniform_beam(5, section), "beam", {"beam"}, bending_only(3));
    const System system(tree, forces);
    const Model& model = system.model;
    const SteadyState state = steady_state(system, model.index(spin.body), {.rotor_speed = Omega});
    REQUIRE(state.converged);

    Workspace workspace(model);
    const Kinematics kin = kinematics(model, state.at.q, workspace);
    Vector Q(model.size());
    system.forces.generalised_forces({state.at, kin}, Q);
    const Vec3 omega(0, 0, Omega);
    double largest = 0;
    for (int a = 1; a < model.size(); ++a) {
        REQUIRE(model.body(a).revolute);
        double moment = 0;
        for (int k = a; k < model.body(a).subtree_end; ++k) {
            const Vec3 c = kin.centre_of_mass(k), rho(c.x(), c.y(), 0);
            const Mat3 J = kin.rotation(k) * model.body(k).J * kin.rotation(k).transpose();
            const Vec3 load = (c - kin.origin(a)).cross(model.body(k).inertia.mass * Omega * Omega * rho) -
                              omega.cross(Vec3(J * omega));
            moment += kin.axis(a).dot(load);
        }
        largest = std::max(largest, std::abs(moment));
        CHECK(Q(a) + moment == Approx(0).margin(1e-7));
    }
    CHECK(largest > 50);  // N m: there was something to balance
    // The cone flattens.
    const double straight = 5 * std::sin(cone);
    CHECK(pose(kin, beam.tip()).p.z() < 0.9 * straight);
    CHECK(pose(kin, beam.tip()).p.z() > 0);
}

TEST_CASE("steady state: a cantilever sags by q L^4 / (8 EI) under a small weight", "[analytic]") {
    // Euler and Bernoulli; the slope is 2.5e-5, so large deflections differ by its square. The elements are exact.
    const double EI = 2e4, mass = 3, length = 10, g = 1e-3;
    const double expected = mass * g * std::pow(length, 4) / (8 * EI);
    const auto error = [&](int elements) {
        Tree tree;
        ForceSet forces;
        const CardanBeam beam = add_cardan_beam(tree, forces, Tree::base(), uniform_beam(length, slender(EI, mass)),
                                                "beam", {"beam"}, bending_only(elements));
        forces.set_gravity({0, 0, -g});
        const System system(tree, forces);
        const SteadyState state = steady_state(system, -1);
        REQUIRE(state.converged);
        Workspace workspace(system.model);
        const Vec3 tip = pose(kinematics(system.model, state.at.q, workspace), beam.tip()).p;
        CHECK(tip.y() == Approx(0).margin(1e-12));
        return -tip.z() / expected - 1;
    };
    for (const int elements : {1, 2, 4, 8}) CHECK(error(elements) == Approx(0).margin(1e-9));
}

TEST_CASE("steady state: gravity across the rotor axis in rotation is refused as periodic", "[analytic]") {
    HingedBar bar;
    bar.gravity = {0, -units::standard_gravity, 0};
    // Gravity in the rotor plane has no moment about the hinge of a bar that lies in it, but a bent bar feels it.
    const System system = bar.system();
    CHECK(contains(numerical_error([&] { (void)steady_state(system, 0, {.rotor_speed = 2}); }), "periodic"));
    CHECK(contains(numerical_error([&] { (void)steady_state(system, 0, {.rotor_speed = 2}); }), "no constant steady"));
    CHECK(steady_state(system, 0).converged);  // at rest it is a load as any other
}

TEST_CASE("steady state: an eccentric rotor on an elastic support is refused as periodic, a balanced one is not",
          "[analytic]") {
    const int spin = eccentric_rotor(0).model.index("spin");
    CHECK(contains(numerical_error([&] { (void)steady_state(eccentric_rotor(0.01), spin, {.rotor_speed = 2}); }),
                   "periodic"));
    CHECK(steady_state(eccentric_rotor(0.01), spin).converged);
    const SteadyState balanced = steady_state(eccentric_rotor(0), spin, {.rotor_speed = 2});
    CHECK(balanced.converged);
    CHECK(balanced.at.q(eccentric_rotor(0).model.index("support")) == Approx(0).margin(1e-12));
}

TEST_CASE("steady state: where several equilibria exist the starting point decides", "[analytic]") {
    // Upside down on a weak spring: k q = m g l sin q besides q = 0.
    const double k = 20, m = 2, length = 1.5;
    const System system = pendulum(k, 0, m, length, true);
    const double expected =
        bisect([&](double q) { return k * q - m * units::standard_gravity * length * std::sin(q); }, 0.5, 3);
    for (const double side : {1.0, -1.0}) {
        const SteadyState state = steady_state(system, -1, {.initial = Vector::Constant(1, side)});
        REQUIRE(state.converged);
        CHECK(state.at.q(0) == Approx(side * expected).epsilon(1e-10));
    }
    CHECK(steady_state(system, -1).at.q(0) == Approx(0).margin(1e-12));
}

TEST_CASE("steady state: a load that no equilibrium can carry is reported with the last iterate", "[analytic]") {
    // m g l sin q = M has a solution up to M = m g l = 29.4 N m only.
    const double limit = 2 * units::standard_gravity * 1.5;
    const SteadyState below = steady_state(pendulum(0, 0.9 * limit), -1);
    REQUIRE(below.converged);
    CHECK(std::abs(below.at.q(0)) == Approx(std::asin(0.9)).epsilon(1e-10));
    const SteadyState above = steady_state(pendulum(0, 1.1 * limit), -1);
    CHECK_FALSE(above.converged);
    CHECK(contains(above.message, "steady state not found"));
    CHECK(contains(above.message, "approach the load in steps"));
    REQUIRE(above.at.q.size() == 1);
    CHECK(std::isfinite(above.at.q(0)));
    CHECK(std::abs(above.at.q(0)) > 0.1);
    // (M - m g l sin q) / (m g l), the residual beside the stiffness of the start.
    CHECK(above.residual == Approx(1.1 - std::abs(std::sin(above.at.q(0)))).epsilon(1e-9));
    CHECK(above.residual > 0.0999);
}

TEST_CASE("steady state: too few iterations are reported with the last iterate", "[analytic]") {
    const HingedBar bar;
    const System system = bar.system();
    const SteadyState state = steady_state(system, 0, {.rotor_speed = 3, .iterations = 1});
    CHECK_FALSE(state.converged);
    CHECK(state.iterations == 1);
    CHECK(contains(state.message, "limit of iterations"));
    CHECK(state.residual > 1e-8);
    // One full Newton step from the straight bar: k rest / (k + m Omega^2 (offset + length) length).
    CHECK(state.at.q(1) == Approx(30 * 0.3 / (30 + 1.5 * 9 * 2.5 * 2)).epsilon(1e-12));
}

TEST_CASE("steady state: a rigid rotor has nothing to solve", "[analytic]") {
    Tree tree;
    add_joint(tree, {.name = "spin", .inertia = {2, {0.1, 0, 0}, Mat3::Identity()}});
    const SteadyState state = steady_state(System(tree, ForceSet{}), 0, {.rotor_speed = 2, .azimuth = 0.3});
    CHECK(state.converged);
    CHECK(state.at.q(0) == 0.3);
    CHECK(state.at.qd(0) == 2);
}

TEST_CASE(
    "steady state: speeds that are not finite or without a rotor, and a starting point of another size, are refused",
    "[property]") {
    const System system = HingedBar{}.system();
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    check_refused([&] { (void)steady_state(system, 0, {.rotor_speed = nan}); }, {"rotor speed", "nan", "finite"});
    check_refused([&] { (void)steady_state(system, 0, {.rotor_speed = inf}); }, {"rotor speed", "inf", "finite"});
    check_refused([&] { (void)steady_state(system, 0, {.azimuth = nan}); }, {"azimuth", "nan", "finite"});
    check_refused([&] { (void)steady_state(system, -1, {.rotor_speed = 2}); }, {"rotor speed", "2", "without rotor"});
    check_refused([&] { (void)steady_state(system, 0, {.initial = Vector::Zero(1)}); },
                  {"size of the starting point = 1", "2, one per coordinate"});
    for (int spin : {2, 99, -7})
        check_refused([&] { (void)steady_state(system, spin, {}); },
                      {"index of the spin coordinate", "-1 (none) ... 1"});
}

TEST_CASE("steady state: forces that are not a number are no equilibrium, and nothing old is left in the result",
          "[property]") {
    Tree tree;
    const BodyId arm = tree.add_body({.name = "arm", .inertia = {1, Vec3(1, 0, 0), Mat3::Identity()}});
    double extra = 0.1;
    ForceSet forces;
    forces.add_spring("spring", arm, 2.0);
    forces.add_element({.name = "user",
                        .coordinates = {arm},
                        .evaluate =
                            [&](const ElementView&, ElementForces& out) {
                                if (extra > 5) throw std::runtime_error("from a user force");
                                out.Q(0) += extra;
                            },
                        .jacobian = [](const ElementView&, ElementJacobian&) {}});
    const System system(tree, forces);
    SteadySolver solver(system, -1);
    SteadyState state;
    solver.solve({}, state);
    CHECK(state.converged);
    CHECK(state.at.q(0) == Approx(0.05));
    extra = std::numeric_limits<double>::quiet_NaN();
    solver.solve({}, state);
    CHECK_FALSE(state.converged);
    CHECK_FALSE(state.message.empty());
    extra = 0.1;
    solver.solve({}, state);
    CHECK(state.converged);
    extra = 10;
    CHECK_THROWS_AS(solver.solve({}, state), std::runtime_error);
    CHECK_FALSE(state.converged);
}

TEST_CASE("steady state: springs as weak as they may be give as far as they have to, in any unit",
          "[solvers][analytic]") {
    // 60 N on 1 N/m, 60 N m on 1 N m/rad: alone, and at the end of an arm of 0.1 m.
    struct Units {
        double length, mass, time;
    };
    for (const Units& u : {Units{1, 1, 1}, {1e3, 1, 1e3}, {1e6, 1e9, 1e6}, {1e-3, 1, 1}, {1e9, 1e-3, 1.0 / 3600}})
        for (const double arm : {0.0, 0.1}) {
            CAPTURE(u.length, arm);
            const double force = u.mass * u.length / (u.time * u.time), moment = force * u.length;
            Tree tree;
            ForceSet forces;
            const FrameId at = tree.add_frame(Tree::base(), Placement::translation({arm * u.length, 0, 0}), "at");
            const Link turn = add_joint(
                tree,
                {.name = "turn", .inertia = {u.mass, Vec3::Zero(), u.mass * u.length * u.length * Mat3::Identity()}});
            const Link slide = add_joint(tree, {.name = "slide",
                                                .inboard = at,
                                                .kind = JointKind::prismatic,
                                                .axis = Vec3::UnitX(),
                                                .inertia = {u.mass, Vec3::Zero(), Mat3::Zero()}});
            forces.add_spring("slide", slide.body, force / u.length);
            forces.add_spring("turn", turn.body, moment);
            forces.add_wrench({"force", slide.axes, {Vec3(60 * force, 0, 0), Vec3::Zero()}, WrenchAxes::base});
            forces.add_wrench({"moment", turn.axes, {Vec3::Zero(), Vec3(0, 0, 60 * moment)}, WrenchAxes::base});
            const SteadyState state = steady_state(System(tree, forces), -1);
            REQUIRE(state.converged);
            CHECK(state.at.q(0) == Approx(60).epsilon(1e-12));
            CHECK(state.at.q(1) / u.length == Approx(60).epsilon(1e-12));
        }
}

TEST_CASE("steady state: memory that runs out is an error that says for what", "[property]") {
    if (!AllocationGuard::works()) return;
    constexpr int n = 60000;
    Tree tree;
    ForceSet forces;
    for (int k = 0; k < n; ++k) {
        const BodyId body = tree.add_body({.name = text("body ", k), .inertia = {1, Vec3::Zero(), Mat3::Identity()}});
        forces.add_spring(text("spring ", k), body, 10);
    }
    const System system(tree, forces);
    const LittleMemory little;
    CHECK_THROWS_MATCHES(SteadySolver(system, -1), MemoryError,
                         Catch::Matchers::Message("not enough memory for the steady state of 60000 coordinates"));
}
