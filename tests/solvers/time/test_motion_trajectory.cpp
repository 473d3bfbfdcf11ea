// Motions that follow commands: a prescribed drive.
#include "mbs/base/units.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/tree_tools.hpp"

#include <cmath>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

TEST_CASE("motion: a trajectory is the motion it describes", "[solvers][motion][property]") {
    const Trajectory trajectory(1, {0.2, -0.1, 0}, 1.4, {0.5, 0.8});
    const Motion motion = Motion::trajectory(trajectory);
    CHECK(motion.kind() == "trajectory");
    CHECK(motion.breaks() == trajectory.breaks());
    for (double t : {0.5, 1.1, 2.0, 3.3, 9.0}) {
        const MotionState m = motion.at(t, t);
        const Trajectory::State s = trajectory.at(t);
        CHECK(m.position == s.position);
        CHECK(m.velocity == s.rate);
        CHECK(m.acceleration == s.acceleration);
    }
}

TEST_CASE("motion: an event gives a driven arm a new command in mid-travel; its drive supplies the change of energy",
          "[solvers][motion][analytic]") {
    // A flywheel on a driven joint, and a pendulum far away to have something to integrate.
    constexpr double J = 3;
    Tree tree;
    ForceSet forces;
    const Link wheel = add_joint(tree, {.name = "wheel",
                                        .inertia = {1, Vec3::Zero(), Vec3(J, J, J).asDiagonal()},
                                        .role = CoordinateRole::prescribed});
    add_joint(tree, {.name = "pendulum", .axis = Vec3::UnitY(), .inertia = {1, Vec3(0, 0, -1), Mat3::Zero()}});
    forces.set_gravity({0, 0, -units::standard_gravity});
    const System system(tree, forces);
    const int i = system.model.index(wheel.body), pendulum = 1 - i;
    const TrajectoryLimits limits{0.5, 0.8};
    IntegrationOptions options;
    Event command{.name = "new command", .direction = 1};
    command.function = [](const StateView& in) { return in.time - 1.3; };
    command.action = [&](Integrator& integrator) {
        const DynamicState& now = integrator.state();
        const Trajectory back(now.time, {now.q(i), now.qd(i), 0}, -0.5, limits);
        integrator.set_motion(i, Motion::trajectory(back));
        return AfterEvent::restart;
    };
    options.events = {command};
    Vector q = Vector::Zero(2);
    q(pendulum) = 0.1;
    const Trajectory forth(0, {0, 0, 0}, 2, limits);
    Integrator integrator(system, {{i, Motion::trajectory(forth)}}, 0, q, Vector::Zero(2), options);
    REQUIRE(integrator.advance(1).reached());
    const double rate = forth.at(1).rate;
    CHECK(integrator.state().qd(i) == rate);
    CHECK(integrator.work().drives == Approx(J * rate * rate / 2).epsilon(1e-5));
    REQUIRE(integrator.advance(9).reached());
    CHECK(integrator.state().q(i) == -0.5);
    CHECK(integrator.state().qd(i) == 0);
    CHECK(integrator.work().drives == Approx(0).margin(1e-5));
    CHECK(integrator.statistics().restarts >= 1);
}
