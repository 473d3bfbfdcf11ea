// Springs, dampers and cables between points: derivatives, energy, and mechanisms held by them.
#include "elements/machine_elements/point_spring.hpp"
#include "mbs/system/joint_loads.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/elements/machine_elements/differenced_forces.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/tree_tools.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace point_spring_tests {

constexpr double gravity = 9.81;

// Shaft, slider, two rods with masses at their ends, and spring-dampers from the slider to the middle of the rods; z
// up.
//                                                                                         [IFToMM benchmark A05]
struct Governor {
    explicit Governor(CoordinateRole shaft) : system(make(shaft)) {}
    static System make(CoordinateRole role) {
        const auto box = [](double m, double a, double b, double c) {
            return Vec3(m / 12 * Vec3(b * b + c * c, a * a + c * c, a * a + b * b));
        };
        const auto diagonal = [](const Vec3& moments) { return Mat3(moments.asDiagonal()); };
        Tree tree;
        const Link shaft = add_joint(
            tree, {.name = "shaft", .inertia = {0.3, {0, 0, 0.5}, diagonal(box(0.3, 0.01, 0.01, 1))}, .role = role});
        const Link slider = add_joint(tree, {.name = "s",
                                             .inboard = shaft.axes,
                                             .kind = JointKind::prismatic,
                                             .inertia = {3, Vec3::Zero(), diagonal(box(3, 0.1, 0.1, 0.1))}});
        ForceSet forces;
        forces.set_gravity({0, 0, -gravity});
        for (const double side : {1.0, -1.0}) {
            const char* name = side > 0 ? "alpha" : "alpha opposite";
            // The rod lies along x of a frame whose y is the hinge; on the other side the frame is turned by half a
            // turn.
            const FrameId top =
                tree.add_frame(shaft.axes, {rot_z(side > 0 ? 0 : pi), {side * 0.05, 0, 1}}, text(name, " hinge"));
            const RigidInertia bar{0.3, {0.5, 0, 0}, diagonal(box(0.3, 1, 0.01, 0.01))};
            const RigidInertia mass{5, {1, 0, 0}, Mat3::Zero()};
            const Link rod =
                add_joint(tree, {.name = name, .inboard = top, .axis = Vec3::UnitY(), .inertia = bar + mass});
            add_point_spring(forces,
                             {.name = text(name, " spring"),
                              .a = tree.add_frame(slider.axes, Placement::translation({side * 0.05, 0, 0}),
                                                  text(name, " on slider")),
                              .b = tree.add_frame(rod.axes, Placement::translation({0.5, 0, 0}), text(name, " middle")),
                              .stiffness = 8e5,
                              .damping = 4e4,
                              .length = 0.5});
        }
        return {tree, forces};
    }
    Vector vector(double shaft, double s, double alpha) const {
        Vector q(4);
        q(system.model.index("shaft")) = shaft;
        q(system.model.index("s")) = s;
        q(system.model.index("alpha")) = q(system.model.index("alpha opposite")) = alpha;
        return q;
    }

    System system;
};

}  // namespace point_spring_tests

using namespace point_spring_tests;

TEST_CASE("point spring: derivatives, energy and power on random trees", "[property]") {
    for (unsigned seed = 0; seed < 10; ++seed)
        for (const bool cable : {false, true}) {
            CAPTURE(seed, cable);
            Random random(seed);
            Tree tree = random_tree(random, {.bodies = 10});
            const FrameId a = tree.add_frame(tree.frame_of(BodyId{2}), random_placement(random), "a");
            const FrameId b = tree.add_frame(tree.frame_of(BodyId{9}), random_placement(random), "b");
            const double damping = cable ? 0 : 0.7;
            ForceSet forces;
            add_point_spring(forces, {"spring", a, b, 3, damping, 0.4, cable});
            const System system(tree, forces);
            const int n = system.model.size();
            const Vector q = random_state(random, n), qd = random_state(random, n);
            const DifferencedForces d = differenced(system, q, qd);
            CHECK(d.by_q.norm() > 0);
            CHECK(scaled(d.own.elastic + d.by_q, d.by_q) < 1e-7);
            CHECK(scaled(d.own.damping + d.by_qd, d.by_qd) < 1e-7);
            CHECK(scaled(d.Q_at_rest + d.slope, d.slope) < 1e-7);
            CHECK(max_abs(d.own.loads) == 0);
            if (damping > 0) CHECK((d.Q - d.Q_at_rest).dot(qd) < 0);
        }
}

TEST_CASE("point spring: a cable hangs slack, then holds", "[analytic]") {
    // A mass that is dropped and caught by a cable: v^2/2 = g h, then a half swing of sqrt(k/m).
    Tree tree;
    const Link mass =
        add_joint(tree, {.name = "z", .kind = JointKind::prismatic, .inertia = {2, Vec3::Zero(), Mat3::Zero()}});
    ForceSet forces;
    forces.set_gravity({0, 0, -gravity});
    add_point_spring(
        forces, {.name = "cable", .a = Tree::base(), .b = mass.axes, .stiffness = 500, .length = 1, .cable = true});
    const System system(tree, forces);
    IntegrationOptions options;
    options.tolerances = {1e-9, 1e-11, 1e-11, 1e-10, 1e-10};
    Integrator run(system, {}, 0, Vector{{-0.2}}, Vector::Zero(1), options);
    const double caught = std::sqrt(2 * 0.8 / gravity);
    REQUIRE(run.advance(0.9 * caught).reached());
    CHECK(run.state().qdd(0) == Approx(-gravity));
    // Lowest: k x^2 / 2 = m g (0.8 + x).
    double lowest = 0;
    for (int i = 1; i <= 400; ++i) {
        REQUIRE(run.advance(0.9 * caught + i * 1e-3).reached());
        lowest = std::min(lowest, run.state().q(0));
    }
    const double k = 500, w = 2 * gravity, x = (w + std::sqrt(w * w + 2 * k * w * 0.8)) / k;
    CHECK(lowest == Approx(-1 - x).epsilon(1e-5));
    CHECK(std::abs(run.energy().error) < 1e-5);
    // Joint loads know it: the slide carries nothing while the cable does.
    const DynamicState& now = run.state();
    Workspace workspace(system.model);
    const Kinematics kin = kinematics(system.model, now.q, workspace);
    const JointLoads loads = joint_loads({now, kin}, system.forces, now.qdd);
    CHECK(std::abs(loads.joint.at(0).force.z()) < 1e-6);
}

TEST_CASE("point spring: the stiff flyball governor", "[discrete]") {
    const Governor governor(CoordinateRole::free);
    const System& system = governor.system;
    struct Row {
        double t, s, alpha, omega, s_rate;
    };
    const std::vector<Row> rows = {{0.1, 0.523836476, 0.496173869, 6.10371781, 0.45927181},
                                   {0.5, 0.743249425, 0.259491382, 5.10341542, 0.05211978},
                                   {1, 0.501420922, 0.521833302, 6.27112574, -0.12215149},
                                   {5, 0.535563104, 0.482874577, 6.02249650, -0.54368269},
                                   {10, 0.619622917, 0.390073702, 5.54820362, -0.74760335}};
    IntegrationOptions options;
    options.tolerances = {1e-9, 1e-11, 1e-11, 1e-10, 1e-10};
    Integrator run(system, {}, 0, governor.vector(0, 0.5, pi / 6), governor.vector(2 * pi, 0, 0), options);
    for (const Row& row : rows) {
        CAPTURE(row.t);
        REQUIRE(run.advance(row.t).reached());
        const DynamicState& now = run.state();
        CHECK(now.q(system.model.index("s")) == Approx(row.s).margin(1e-6));
        CHECK(now.q(system.model.index("alpha")) == Approx(row.alpha).margin(1e-6));
        CHECK(now.q(system.model.index("alpha opposite")) == Approx(row.alpha).margin(1e-6));
        CHECK(now.qd(system.model.index("shaft")) == Approx(row.omega).margin(1e-5));
        CHECK(now.qd(system.model.index("s")) == Approx(row.s_rate).margin(1e-5));
    }
}

TEST_CASE("point spring: the flyball governor driven at a constant speed", "[discrete]") {
    const Governor governor(CoordinateRole::prescribed);
    const System& system = governor.system;
    const int shaft = system.model.index("shaft");
    const SteadyState state =
        steady_state(system, shaft, {.rotor_speed = 2 * pi, .initial = governor.vector(0, 0.69, 0.31)});
    REQUIRE(state.converged);
    CHECK(state.at.q(system.model.index("alpha")) == Approx(0.3127130943).epsilon(1e-9));
    CHECK(state.at.q(system.model.index("s")) == Approx(0.6921647026).epsilon(1e-9));
    // Where both rods move alike.
    const SecondOrderSystem all =
        restrict_to(linearise(system, state.at), system.model.coordinates().free_without(shaft));
    Matrix alike = Matrix::Zero(3, 2);
    for (int i = 0; i < 3; ++i) alike(i, entry(all.coordinates, i) == system.model.index("s") ? 0 : 1) = 1;
    SecondOrderSystem symmetric;
    symmetric.M = alike.transpose() * all.M * alike;
    symmetric.C = alike.transpose() * all.C * alike;
    symmetric.K = alike.transpose() * all.K * alike;
    symmetric.K_elastic = alike.transpose() * all.K_elastic * alike;
    symmetric.coordinates = {0, 1};
    const std::vector<Mode> found = modes(symmetric);
    REQUIRE(found.size() == 3);
    CHECK(found[0].eigenvalue.imag() == Approx(5.466241).epsilon(1e-6));
    CHECK(found[0].eigenvalue.real() == Approx(-3.7e-7).margin(1e-7));
    std::vector<double> real = {found[1].eigenvalue.real(), found[2].eigenvalue.real()};
    std::ranges::sort(real);
    CHECK(real[0] == Approx(-3182.17).epsilon(1e-5));
    CHECK(real[1] == Approx(-20.14673).epsilon(1e-6));
}

TEST_CASE("point spring: what is out of range is refused", "[bad-input]") {
    ForceSet forces;
    const FrameId a{0}, b{1};
    check_refused([&] { add_point_spring(forces, {"s", a, b, -1}); }, {"'s'", "stiffness", "-1"});
    check_refused([&] { add_point_spring(forces, {"s", a, b, 1, -1}); }, {"damping", "-1"});
    check_refused([&] { add_point_spring(forces, {"s", a, b, 1, 0, -1}); }, {"length", "-1"});
    check_refused([&] { add_point_spring(forces, {"s", a, b}); }, {"stiffness and damping"});
    check_refused([&] { add_point_spring(forces, {"s", a, a, 1}); }, {"frames"});
}
