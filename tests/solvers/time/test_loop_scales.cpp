// Loops of any size, and bodies of any weight in them: accelerations beside closed forms, and the same mechanism in
// other units, whose numbers must be the same after conversion.
#include "elements/machine_elements/point_spring.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "solvers/equilibrium/natural_modes.hpp"
#include "solvers/linear/loop_reduction.hpp"
#include "tests/mbs/loops/closed_trees.hpp"
#include "tests/solvers/time/crank_motion.hpp"
#include "tests/solvers/time/integrated_systems.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"

#include <vector>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace loop_scale_tests {

// How many units make 1 m, 1 kg, 1 s.
struct Units {
    const char* name;
    double length = 1, mass = 1, time = 1;

    double force() const { return mass * length / (time * time); }
    double moment() const { return force() * length; }
    Vec3 of_length(const Vec3& x) const { return length * x; }
    RigidInertia inertia(RigidInertia body) const {
        body.mass *= mass;
        body.com *= length;
        body.J *= mass * length * length;
        return body;
    }
};
const std::vector<Units> all_units = {{"m, kg, s"},
                                      {"mm, kg, ms", 1e3, 1, 1e3},
                                      {"um, ug, us", 1e6, 1e9, 1e6},
                                      {"km, kg, s", 1e-3, 1, 1},
                                      {"nm, t, h", 1e9, 1e-3, 1.0 / 3600}};

// A crank on a torsion spring, a rod and a piston on a spring with a damper, under gravity: a revolute cut, of which
// three of five equations are redundant, lengths and directions.
struct Machine {
    Units units;
    System system;

    explicit Machine(const Units& in, double size = 1) : units(in), system(make(in, size)) {}
    static System make(const Units& in, double size) {
        const double r = 0.1 * size * in.length, l = 0.3 * size * in.length, x = size * size;
        Tree tree;
        ForceSet forces;
        LoopSet loops;
        const auto bar = [&](double mass, double length) {
            return in.inertia(bar_along_x(mass * x * size, length * size));
        };
        const Bar crank = add_bar(tree, "crank", Tree::base(), r, bar(0.4, 0.1));
        const Bar rod = add_bar(tree, "rod", crank.end, l, bar(0.3, 0.3));
        const Link piston = add_joint(tree, {.name = "piston",
                                             .kind = JointKind::prismatic,
                                             .axis = Vec3::UnitX(),
                                             .inertia = in.inertia({0.5 * x * size, Vec3::Zero(), Mat3::Zero()})});
        loops.add_joint({"pin", CutKind::revolute, rod.end, piston.axes});
        forces.set_gravity(Vec3(0, -9.81, 0) * in.length / (in.time * in.time));
        forces.add_spring("spring", piston.body, 300 * x * in.force() / in.length,
                          2 * x * in.force() / in.length * in.time, 0.3 * size * in.length);
        forces.add_spring("hinge", crank.body, 0.5 * x * size * size * in.moment(), 0);
        return {tree, forces, loops};
    }
    Vector from_si(const Vector& q) const { return Vec3(q(0), q(1), q(2) * units.length); }
    Vector to_si(const Vector& q) const { return Vec3(q(0), q(1), q(2) / units.length); }
};

// Accelerations of a chain of hinged slender bars along x that begins and ends at a height of zero, let go: those of
// the hinges from the masses of bars whose ends move, m/6 [2 1; 1 2].
Vector chain_accelerations(int bars, double gravity) {
    const int inner = bars - 1;
    Vector diagonal = Vector::Constant(inner, 4.0 / 6), right = Vector::Constant(inner, -gravity);
    for (int i = 1; i < inner; ++i) {
        const double factor = 1.0 / 6 / diagonal(i - 1);
        diagonal(i) -= factor / 6;
        right(i) -= factor * right(i - 1);
    }
    Vector y = Vector::Zero(bars + 1);
    for (int i = inner; i >= 1; --i) y(i) = (right(i - 1) - y(i + 1) / 6) / diagonal(i - 1);
    return y;
}

}  // namespace loop_scale_tests

using namespace loop_scale_tests;

TEST_CASE("loop scales: a rod of any weight moves with its crank and piston", "[analytic]") {
    for (const double weight : {0.3, 1e-3, 1e-6, 5e-9, 1e-12, 1e-15, 1e-18}) {
        for (const CutKind kind : {CutKind::revolute, CutKind::cylindrical}) {
            CAPTURE(weight, static_cast<int>(kind));
            const CrankMotion motion{.rod = weight};
            Tree tree;
            ForceSet forces;
            LoopSet loops;
            const Bar crank =
                add_bar(tree, "crank", Tree::base(), motion.r, {0.5, Vec3::Zero(), motion.inertia * Mat3::Identity()});
            const Bar rod = add_bar(tree, "rod", crank.end, motion.l, bar_along_x(weight, motion.l));
            const Link piston = add_joint(tree, {.name = "piston",
                                                 .kind = JointKind::prismatic,
                                                 .axis = Vec3::UnitX(),
                                                 .inertia = {motion.piston, Vec3::Zero(), Mat3::Zero()}});
            loops.add_joint({"pin", kind, rod.end, piston.axes});
            forces.add_wrench({.name = "push", .frame = piston.axes, .wrench = {Vec3(7, 0, 0), Vec3::Zero()}});
            const System system(tree, forces, loops);
            const double t = 1, rate = 10;
            const Vec3 Z(1, motion.rod_rate(t) - 1, motion.piston_rate(t));
            Integrator run(system, {}, 0, Vec3(t, motion.rod_angle(t) - t, motion.place(t)), rate * Z);
            const double crank_acceleration = motion.acceleration(t, rate, 0, 7);
            const double of_piston = motion.piston_second(t) * rate * rate + Z(2) * crank_acceleration;
            CHECK(run.state().qdd(0) == Approx(crank_acceleration).epsilon(1e-9));
            CHECK(run.state().qdd(2) == Approx(of_piston).epsilon(1e-9));
            // What the pin exerts on the piston.
            Workspace workspace(system.model);
            const Kinematics kin = kinematics(system.model, run.state().q, workspace);
            CHECK(system.loops.reaction(kin, 0, run.state().lambda).force(0) ==
                  Approx(motion.piston * of_piston - 7).epsilon(1e-8));
            REQUIRE(run.advance(0.2).reached());
            // The balance of energy along the one coordinate.
            const double now = run.state().q(0), squared = run.state().qd(0) * run.state().qd(0);
            CHECK(motion.mass(now) * squared / 2 ==
                  Approx(motion.mass(t) * rate * rate / 2 + 7 * (motion.place(now) - motion.place(t))).epsilon(1e-6));
        }
    }
}

TEST_CASE("loop scales: a straight chain of hinged bars that a slider ends", "[analytic]") {
    for (const int bars : {10, 40, 160}) {
        CAPTURE(bars);
        Tree tree;
        FrameId end = Tree::base();
        for (int i = 0; i < bars; ++i) end = add_bar(tree, text("bar ", i), end, 1, bar_along_x(1, 1)).end;
        const Link slider = add_joint(tree, {.name = "slider",
                                             .kind = JointKind::prismatic,
                                             .axis = Vec3::UnitX(),
                                             .inertia = {1, Vec3::Zero(), Mat3::Zero()}});
        LoopSet loops;
        loops.add_joint({"pin", CutKind::revolute, end, slider.axes});
        ForceSet forces;
        forces.set_gravity({0, -loop_gravity, 0});
        const System system(tree, forces, loops);
        Vector q = Vector::Zero(bars + 1);
        q(system.model.index(slider.body)) = bars;
        Integrator run(system, {}, 0, q, Vector::Zero(bars + 1));
        const Vector y = chain_accelerations(bars, loop_gravity);
        double before = 0, error = 0;
        for (int i = 0; i < bars; ++i) {
            const double turn = y(i + 1) - y(i);
            error = std::max(error, std::abs(run.state().qdd(system.model.index(text("bar ", i))) - (turn - before)));
            before = turn;
        }
        CHECK(error < 1e-9 * loop_gravity);
        REQUIRE(run.advance(0.02).reached());
        CHECK(std::abs(run.energy().error) < 1e-6);
    }
}

TEST_CASE("loop scales: closing, equilibrium, modes and motion are the same in all units", "[property]") {
    const Machine reference(all_units[0]);
    const Vector guess = Vec3(0.9, -1.2, 0.3);
    const Closure closed = close_loops(reference.system.model, reference.system.loops, guess);
    REQUIRE(closed.converged);
    const SteadyState rest = steady_state(reference.system, -1, {.initial = guess});
    REQUIRE(rest.converged);
    const NaturalModes modes = natural_modes(reference.system, -1, 0, guess);
    const auto moved = [&](const Machine& machine) {
        IntegrationOptions options;
        const Units& u = machine.units;
        options.tolerances = {1e-9, 1e-10, 1e-10 * u.length, 1e-9 / u.time, 1e-9 * u.length / u.time};
        Integrator run(machine.system, {}, 0, machine.from_si(closed.q), Vector::Zero(3), options);
        REQUIRE(run.advance(0.5 * u.time).reached());
        Vector out(7);
        out << machine.to_si(run.state().q), machine.to_si(run.state().qd) * u.time, run.state().lambda(0) / u.force();
        return out;
    };
    const Vector motion = moved(reference);
    for (const Units& units : all_units) {
        CAPTURE(units.name);
        const Machine machine(units);
        const System& system = machine.system;
        const Closure same = close_loops(system.model, system.loops, machine.from_si(guess));
        REQUIRE(same.converged);
        CHECK(same.rank == closed.rank);
        CHECK((machine.to_si(same.q) - closed.q).norm() < 1e-8);  // nearest: a minimum, half the digits
        const SteadyState steady = steady_state(system, -1, {.initial = machine.from_si(guess)});
        REQUIRE(steady.converged);
        CHECK((machine.to_si(steady.at.q) - rest.at.q).norm() < 1e-11);
        CHECK(steady.at.lambda(0) / units.force() == Approx(rest.at.lambda(0)).epsilon(1e-9));
        const NaturalModes found = natural_modes(system, -1, 0, machine.from_si(guess));
        REQUIRE(found.modes.size() == modes.modes.size());
        CHECK(std::abs(found.modes[0].eigenvalue * units.time - modes.modes[0].eigenvalue) <
              1e-8 * std::abs(modes.modes[0].eigenvalue));
        CHECK((moved(machine) - motion).norm() < 1e-6 * motion.norm());
    }
}

TEST_CASE("loop scales: a loop may be open by a fraction of its size, whatever that is", "[property]") {
    for (const double size : {1e-6, 1e-3, 1.0, 1e3}) {
        CAPTURE(size);
        const Machine machine(all_units[0], size);
        const System& system = machine.system;
        const Closure closed = close_loops(system.model, system.loops, Vec3(0.9, -1.2, 0.3 * size));
        REQUIRE(closed.converged);
        CHECK(closed.gap < 1e-13 * size);
        for (const double open : {1e-8, 1e-5}) {
            const Vector q = closed.q + open * size * Vector::Unit(3, 2);
            if (open < 1e-6)
                CHECK_NOTHROW(Integrator(system, {}, 0, q, Vector::Zero(3)));
            else
                CHECK_THROWS_AS(Integrator(system, {}, 0, q, Vector::Zero(3)), InputError);
        }
    }
}
