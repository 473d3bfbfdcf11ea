// Conservation laws over long times: energy of pendulums and of a spinning flexible beam, momentum of a free body with
// flexible appendages.
#include "elements/cardan_beam/cardan_beam.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/solvers/time/integrated_systems.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/tree_tools.hpp"

#include <algorithm>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

// Four rods on hinges, 1 m and 1 kg each, which tumble over one another.
System pendulums() {
    Tree tree;
    ForceSet forces;
    FrameId at = Tree::base();
    const RigidInertia rod{1, Vec3(0, 0, -0.5), Vec3(1. / 12, 1. / 12, 0.001).asDiagonal()};
    for (int i = 0; i < 4; ++i) {
        const Link link = testing::add_joint(
            tree, {.name = text("hinge ", i + 1), .inboard = at, .axis = Vec3::UnitY(), .inertia = rod});
        at = tree.add_frame(link.axes, Placement::translation({0, 0, -1}), text("end ", i + 1));
    }
    forces.set_gravity({0, 0, -units::standard_gravity});
    return {tree, forces};
}

EngineeringSection soft_section() {
    EngineeringSection s;
    s.mass = 2, s.EA = 4e5, s.GJ = 300, s.EI_flap = 400, s.EI_edge = 900, s.j_flap = 0.01, s.j_edge = 0.02;
    return s;
}

// A soft beam of 6 m on a free hub with a horizontal axis, under gravity that has a part along this axis: natural
// frequencies 0.25 ... 10 Hz.
System spinning_beam() {
    Tree tree;
    ForceSet forces;
    const Link hub = testing::add_joint(
        tree, {.name = "hub", .axis = Vec3::UnitX(), .inertia = {5, Vec3::Zero(), Vec3(3, 3, 3).asDiagonal()}});
    const FrameId root = tree.add_frame(hub.axes, Placement::rotation(rot_y(pi / 2)), "root");
    add_cardan_beam(tree, forces, root, uniform_beam(6, soft_section()), "beam", {"beam"},
                    {.elements = 2, .torsion = false});
    forces.set_gravity({0.5, 0, -units::standard_gravity});
    return {tree, forces};
}

// The largest change of kinetic and potential energy at 400 times of 100 s, over the largest kinetic energy.
double drift(const System& system, const Vector& q, const Vector& qd, IntegrationOptions options) {
    options.integrate_work = false;
    Integrator integrator(system, {}, 0, q, qd, options);
    Workspace workspace(system.model);
    double kinetic = 0, most = 0, change = 0, start = 0;
    for (int i = 0; i <= 400; ++i) {
        REQUIRE(integrator.advance(i / 4.0).reached());
        const DynamicState& now = integrator.state();
        const Kinematics kin = kinematics(system.model, now.q, workspace);
        kinetic = kinetic_energy(kin, now.qd);
        most = std::max(most, kinetic);
        const double energy = kinetic + system.forces.potential_energy({now, kin});
        if (i == 0) start = energy;
        change = std::max(change, std::abs(energy - start));
    }
    REQUIRE(most > 50);
    return change / most;
}
double drift_of_pendulums(Method method, double tolerance) {
    Vector q(4);
    q << 1.5, 0.4, -0.7, 0.9;
    return drift(pendulums(), q, Vector::Zero(4), equal_tolerances(method, tolerance));
}
double drift_of_beam(Method method, double tolerance) {
    const System system = spinning_beam();
    Vector qd = Vector::Zero(system.model.size());
    qd(system.model.index("hub")) = 3;
    return drift(system, Vector::Zero(system.model.size()), qd, equal_tolerances(method, tolerance));
}

}  // namespace

TEST_CASE("time: pendulums that tumble for 100 s keep their energy to 1e-8", "[solvers][time][property]") {
    CHECK(drift_of_pendulums(Method::adams, 1e-12) < 1e-8);
    CHECK(drift_of_pendulums(Method::erk, 1e-11) < 1e-8);
    // What is lost follows the tolerance.
    const double coarse = drift_of_pendulums(Method::adams, 1e-8);
    CHECK(coarse > 1e-8);
    CHECK(coarse < 1e-5);
}

TEST_CASE("time: a flexible beam that spins in gravity for 100 s keeps its energy to 1e-8",
          "[solvers][time][property]") {
    CHECK(drift_of_beam(Method::adams, 1e-11) < 1e-8);
}

TEST_CASE("time: implicit methods too keep the energy to 1e-8 over 100 s if the tolerance is tight",
          "[solvers][time][property][slow]") {
    CHECK(drift_of_pendulums(Method::bdf, 1e-13) < 1e-8);
    CHECK(drift_of_pendulums(Method::dirk, 1e-11) < 1e-8);
    CHECK(drift_of_beam(Method::bdf, 1e-13) < 1e-8);
}

namespace {

// A body in free flight that carries two flexible beams and a damped wheel on a skew axis.
System satellite() {
    Tree tree;
    ForceSet forces;
    const FrameId body = tree.add_frame(add_floating_base(tree), {}, "body");
    tree.weld(body, {30, Vec3(0.1, -0.2, 0.3), Vec3(12, 15, 18).asDiagonal()});
    const Vec3 places[] = {Vec3(0, 1, 0), Vec3(0, -1, 0.2)};
    for (int i = 0; i < 2; ++i) {
        const FrameId root = tree.add_frame(body, {rot_z(i == 0 ? pi / 2 : -pi / 2), places[i]}, text("root ", i + 1));
        CardanBeamOptions options{.elements = 1};
        options.damping = BeamDamping::ratio_at(0.02, 0.5);
        add_cardan_beam(tree, forces, root, uniform_beam(4, soft_section()), text("beam ", i + 1), {"beam", i + 1},
                        options);
    }
    const Link wheel = testing::add_joint(tree, {.name = "wheel",
                                                 .inboard = body,
                                                 .axis = Vec3(1, 0.5, -0.3).normalized(),
                                                 .inertia = {2, Vec3(0.1, 0, 0), Vec3(0.3, 0.2, 0.4).asDiagonal()}});
    forces.add_spring("wheel", wheel.body, 4, 0.05);
    return {tree, forces};
}

}  // namespace

TEST_CASE("time: in free flight momentum is kept and the mass centre goes straight on, whatever moves inside",
          "[solvers][time][property]") {
    struct Case {
        Method method;
        double tolerance, error;
    };
    const System system = satellite();
    const int n = system.model.size();
    Vector q = Vector::Zero(n), qd = q;
    qd.head<6>() << 0.5, -0.3, 0.2, 0.25, -0.1, 0.9;  // mostly about z, the innermost axis
    q(system.model.index("wheel")) = 0.8;
    q(system.model.index("beam 1 element 1 bending y1")) = 0.2;
    q(system.model.index("beam 2 element 1 bending z2")) = -0.15;
    for (const Case& c :
         {Case{Method::bdf, 1e-10, 1e-6}, Case{Method::adams, 1e-10, 1e-7}, Case{Method::dirk, 1e-9, 1e-7},
          Case{Method::erk, 1e-10, 1e-7}, Case{Method::generalised_alpha, 1e-7, 1e-3}}) {
        Integrator integrator(system, {}, 0, q, qd, equal_tolerances(c.method, c.tolerance));
        Workspace workspace(system.model);
        const Momentum before = momentum(kinematics(system.model, q, workspace), qd);
        REQUIRE(integrator.advance(20).reached());
        const DynamicState& now = integrator.state();
        const Momentum after = momentum(kinematics(system.model, now.q, workspace), now.qd);
        const EnergyBalance balance = integrator.energy();
        CAPTURE(static_cast<int>(c.method), now.q(4), balance.dissipated, balance.error);
        CHECK((after.linear - before.linear).norm() < c.error * before.linear.norm());
        CHECK((after.angular - before.angular).norm() < c.error * before.angular.norm());
        CHECK((after.centre - before.centre - 20 / system.model.mass() * before.linear).norm() < c.error);
        CHECK(balance.dissipated > 1);
        CHECK(std::abs(balance.error) < c.error * balance.kinetic);
        CHECK(std::abs(balance.loads) < c.error * balance.kinetic);
    }
}
