// Dry friction in loops: a mechanism passes its dead points, comes to rest where its energy is used up, and stays.
// References: the balance of energy along the one coordinate that there is, in closed form but for a quadrature.
#include "elements/machine_elements/friction.hpp"
#include "solvers/time/stick_slip.hpp"
#include "tests/mbs/loops/closed_trees.hpp"
#include "tests/solvers/time/crank_motion.hpp"
#include "tests/solvers/time/integrated_systems.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace loop_friction_tests {

// A flywheel, a rod and a piston with dry friction in its cylinder; and, if it is not zero, in the bearing of the
// crank.
struct Engine {
    CrankMotion motion = {};
    double friction, bearing, push;  // N, N m, N on the piston
    std::vector<DryFriction> frictions = {};
    System system;

    Engine(double in_cylinder, double in_bearing, double on_piston, CoordinateRole crank = CoordinateRole::free)
        : friction(in_cylinder), bearing(in_bearing), push(on_piston), system(make(crank)) {}
    System make(CoordinateRole role) {
        Tree tree;
        ForceSet forces;
        LoopSet loops;
        const Bar crank = add_bar(tree, "crank", Tree::base(), motion.r,
                                  {0.5, Vec3::Zero(), motion.inertia * Mat3::Identity()}, role);
        const Bar rod = add_bar(tree, "rod", crank.end, motion.l, bar_along_x(motion.rod, motion.l));
        const Link piston = add_joint(tree, {.name = "piston",
                                             .kind = JointKind::prismatic,
                                             .axis = Vec3::UnitX(),
                                             .inertia = {motion.piston, Vec3::Zero(), Mat3::Zero()}});
        loops.add_joint({"pin", CutKind::revolute, rod.end, piston.axes});
        frictions.push_back(add_dry_friction(forces, loops, "cylinder", piston.body, {friction, friction}));
        if (bearing > 0)
            frictions.push_back(add_dry_friction(forces, loops, "bearing", crank.body, {bearing, bearing}));
        forces.add_wrench({.name = "push", .frame = piston.axes, .wrench = {Vec3(push, 0, 0), Vec3::Zero()}});
        return {tree, forces, loops};
    }
    Vector position(double t) const { return Vec3(t, motion.rod_angle(t) - t, motion.place(t)); }
    Vector rates(double t, double rate) const { return rate * Vec3(1, motion.rod_rate(t) - 1, motion.piston_rate(t)); }
    Integrator run(double t, double rate) const {
        IntegrationOptions options = with(Method::dirk, 1e-9, 1e-10);
        options.events = stick_slip(system, frictions, {}, 0, position(t), rates(t, rate));
        return {system, {}, 0, position(t), rates(t, rate), options};
    }
    // Half the square of the crank's rate times the mass, from its start.
    double energy(double start, double rate, double t) const {
        return motion.mass(start) * rate * rate / 2 - friction * motion.travel(start, t) - bearing * (t - start);
    }
};

}  // namespace loop_friction_tests

using namespace loop_friction_tests;

TEST_CASE("friction in a loop: a piston passes its dead centres, where its friction only changes direction",
          "[analytic]") {
    const Engine engine(5, 0, 0);
    const double start = 1, rate = 10;
    Integrator run = engine.run(start, rate);
    for (const double time : {0.1, 0.3, 1.0}) {
        CAPTURE(time);
        REQUIRE(run.advance(time).reached());
        const double t = run.state().q(0);
        CHECK(engine.motion.mass(t) * run.state().qd(0) * run.state().qd(0) / 2 ==
              Approx(engine.energy(start, rate, t)).epsilon(1e-8));
        // The time that it takes: Simpson's rule, kinks of the integrand at dead centres being kept apart.
        double taken = 0;
        for (double from = start; from < t;) {
            const double to = std::min(t, (std::floor(from / pi + 1e-12) + 1) * pi), h = (to - from) / 200;
            for (int i = 0; i < 200; ++i)
                for (const auto& [at, weight] : {std::pair{0.0, 1.0}, {0.5, 4.0}, {1.0, 1.0}}) {
                    const double angle = from + (i + at) * h;
                    taken +=
                        h / 6 * weight * std::sqrt(engine.motion.mass(angle) / (2 * engine.energy(start, rate, angle)));
                }
            from = to;
        }
        CHECK(taken == Approx(time).epsilon(1e-7));
    }
    CHECK(run.state().q(0) == Approx(10.933777).margin(2e-6));
    CHECK(run.statistics().restarts == 3);  // at dead centres, and nowhere else
}

TEST_CASE("friction in a loop: a mechanism stops where its energy is used up, and stays", "[analytic]") {
    for (const double bearing : {0.0, 3.0}) {
        CAPTURE(bearing);
        const Engine engine(150, bearing, 0);
        const double start = 1, rate = 10;
        Integrator run = engine.run(start, rate);
        REQUIRE(run.advance(3).reached());
        double low = start, high = 100;
        while (high - low > 1e-12) {
            const double middle = (low + high) / 2;
            (engine.energy(start, rate, middle) > 0 ? low : high) = middle;
        }
        CHECK(run.state().q(0) == Approx(low).margin(1e-6));
        CHECK(std::abs(run.state().qd(0)) < 1e-9);
        CHECK(engine.frictions.front().state->engaged);
        CHECK(std::abs(run.energy().error) < 1e-5);
    }
}

TEST_CASE("friction in a loop: contacts that hold the same motion share the load", "[analytic]") {
    const double start = 1;
    const CrankMotion motion;
    // What the bearing of the crank holds at the piston.
    const double lever = std::abs(motion.piston_rate(start)), bearing = 0.4, held = 4 + bearing / lever;
    for (const double part : {0.5, 0.99, 1.01, 1.5}) {
        CAPTURE(part);
        const Engine engine(4, bearing, -part * held);
        Integrator run = engine.run(start, 0);
        const double expected = part < 1 ? 0 : motion.acceleration(start, 0, -bearing, engine.push + engine.friction);
        CHECK(run.state().qdd(0) == Approx(expected).margin(1e-9));
        REQUIRE(run.advance(0.1).reached());
        CHECK(run.state().q(0) == Approx(start + expected * 0.005).epsilon(1e-2));
    }
}

TEST_CASE("friction in a loop: a driven crank carries its piston through the dead centres", "[analytic]") {
    const Engine engine(5, 0, 0, CoordinateRole::prescribed);
    // The first start at a dead centre, where the piston stands.
    for (const double start : {0.0, 1.0}) {
        CAPTURE(start);
        Integrator run = engine.run(start, 10);
        for (const double time : {0.1, 0.35, 1.0}) {
            CAPTURE(time);
            REQUIRE(run.advance(time).reached());
            const double t = start + 10 * time, slope = engine.motion.piston_rate(t);
            CHECK(run.state().q(2) == Approx(engine.motion.place(t)).epsilon(1e-9));
            CHECK(run.state().actuator(0) ==
                  Approx(engine.motion.mass_slope(t) * 50 + engine.friction * std::abs(slope)).epsilon(1e-7));
        }
    }
}

TEST_CASE("friction in a loop: the rocker of a four-bar takes energy at every swing", "[analytic]") {
    // A heavy crank turns through; friction in the hinge of the rocker, at rest in its two dead points.
    constexpr double a = FourBar::crank_length, b = FourBar::coupler_length, c = FourBar::rocker_length,
                     d = FourBar::ground_length, torque = 0.8;
    Tree tree;
    ForceSet forces;
    LoopSet loops;
    const Bar crank = add_bar(tree, "crank", Tree::base(), a, {1, Vec3::Zero(), 0.1 * Mat3::Identity()});
    const Bar coupler = add_bar(tree, "coupler", crank.end, b, bar_along_x(b, b));
    const Bar rocker = add_bar(tree, "rocker", tree.add_frame(Tree::base(), Placement::translation({d, 0, 0}), "C"), c,
                               bar_along_x(c, c));
    loops.add_joint({"pin", CutKind::revolute, coupler.end, rocker.end});
    const std::vector<DryFriction> frictions = {
        add_dry_friction(forces, loops, "hinge", rocker.body, {torque, torque})};
    const System system(tree, forces, loops);
    // Angle of the rocker by that of the crank, B above the ground.
    const auto rocker_angle = [](double t) {
        const Vec3 A(a * std::cos(t) - d, a * std::sin(t), 0);
        const double e = A.norm(), cosine = (e * e + c * c - b * b) / (2 * e * c);
        return std::atan2(A(1), A(0)) - std::acos(cosine);
    };
    const auto wrapped = [](double angle) { return std::remainder(angle, 2 * pi); };
    const double start = 0.5;
    const Closure closed = close_loops(system.model, system.loops, FourBar::position(start, 1, 2), {.fixed = {0}});
    REQUIRE(closed.converged);
    REQUIRE(std::abs(wrapped(closed.q(2) - rocker_angle(start))) < 1e-12);
    const Vector rates = close_rates(system.model, system.loops, closed.q, Vec3(12, 0, 0), {.fixed = {0}});
    IntegrationOptions options = with(Method::dirk, 1e-9, 1e-10);
    options.events = stick_slip(system, frictions, {}, 0, closed.q, rates);
    Integrator run(system, {}, 0, closed.q, rates, options);
    const auto kinetic = [&] {
        Workspace workspace(system.model);
        return kinetic_energy(kinematics(system.model, run.state().q, workspace), run.state().qd);
    };
    const double before = kinetic();
    REQUIRE(run.advance(0.9).reached());
    // The swings of the rocker, in small parts.
    double way = 0;
    const int parts = 200000;
    const double end = run.state().q(0);
    CHECK(end > 7);
    for (int i = 0; i < parts; ++i)
        way += std::abs(wrapped(rocker_angle(start + (end - start) * (i + 1) / parts) -
                                rocker_angle(start + (end - start) * i / parts)));
    CHECK(kinetic() == Approx(before - torque * way).epsilon(1e-7));
    REQUIRE(run.advance(30).reached());
    CHECK(run.state().qd.norm() < 1e-9);
    CHECK(frictions.front().state->engaged);
}
