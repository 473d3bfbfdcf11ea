// Sliding masses, oscillators, gears and drives against equations solved by hand.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/simulation.hpp"
#include "tests/support/tree_tools.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

RigidInertia mass_of(double m) {
    return {m, Vec3::Zero(), Mat3::Zero()};
}

RigidInertia wheel(double m, const Vec3& moments) {
    return {m, Vec3::Zero(), moments.asDiagonal()};
}

constexpr CoordinateRole driven_role = CoordinateRole::prescribed;
constexpr CoordinateRole free_role = CoordinateRole::free;

}  // namespace

TEST_CASE("sliding mass: on a rod that turns steadily r'' = (omega cos beta)^2 r, and the drive feels Coriolis",
          "[analytic]") {
    const double m = 1.4, omega = 2.0, r0 = 0.3, v0 = 0.2;
    for (const double beta : {0.0, 0.7}) {  // cone angle of the rod
        Tree tree;
        const Link spin = add_joint(tree, {.name = "spin", .role = driven_role});
        add_joint(tree, {.name = "slide",
                         .inboard = spin.axes,
                         .kind = JointKind::prismatic,
                         .axis = Vec3(std::cos(beta), 0, std::sin(beta)),
                         .inertia = mass_of(m)});
        const System system(tree, {});
        Simulation motion(system, Eigen::Vector2d(0, r0), Eigen::Vector2d(omega, v0));
        const double rate = omega * std::cos(beta);
        for (int i = 1; i <= 4; ++i) {
            motion.advance(0.25, 200);
            const double t = motion.time();
            const double r = r0 * std::cosh(rate * t) + v0 / rate * std::sinh(rate * t);
            const double v = r0 * rate * std::sinh(rate * t) + v0 * std::cosh(rate * t);
            CHECK(motion.q()(1) == Approx(r).epsilon(1e-10));
            CHECK(motion.qd()(1) == Approx(v).epsilon(1e-10));
            const double coriolis = 2 * m * omega * std::cos(beta) * std::cos(beta) * r * v;
            CHECK(motion.response().actuator(0) == Approx(coriolis).epsilon(1e-9));
        }
    }
}

TEST_CASE("sliding mass: on a rod that turns freely the angular momentum about the axis is kept", "[analytic]") {
    const double m = 1.4, J = 0.8;
    Tree tree;
    const Link spin = add_joint(tree, {.name = "spin", .inertia = wheel(1, {J, J, J})});
    add_joint(tree, {.name = "slide",
                     .inboard = spin.axes,
                     .kind = JointKind::prismatic,
                     .axis = Vec3::UnitX(),
                     .inertia = mass_of(m)});
    const System system(tree, {});
    Random random(1);
    for (int i = 0; i < 20; ++i) {
        const Vector q = random_state(random, 2), qd = random_state(random, 2, 3);
        const Vector qdd = Simulation(system, q, qd).response().qdd;
        // d/dt (J + m r^2) omega = 0,  r'' = omega^2 r
        CHECK(qdd(0) == Approx(-2 * m * q(1) * qd(1) * qd(0) / (J + m * q(1) * q(1))).epsilon(1e-12).margin(1e-12));
        CHECK(qdd(1) == Approx(qd(0) * qd(0) * q(1)).epsilon(1e-12).margin(1e-12));
    }
}

TEST_CASE("turntable: a mass without friction runs straight in space, whatever the table does", "[analytic]") {
    Tree tree;
    const FrameId ground = tree.add_frame(Tree::base(), {rot_x(0.3), Vec3(1, 2, 3)}, "ground");
    const Link table = add_joint(tree, {.name = "table", .inboard = ground, .role = driven_role});
    const Link x =
        add_joint(tree, {.name = "x", .inboard = table.axes, .kind = JointKind::prismatic, .axis = Vec3::UnitX()});
    const Link y = add_joint(
        tree,
        {.name = "y", .inboard = x.axes, .kind = JointKind::prismatic, .axis = Vec3::UnitY(), .inertia = mass_of(0.7)});
    const System system(tree, {});
    const double omega = 3.0;
    Simulation motion(system, Vec3(0.2, 0.5, -0.4), Vec3(omega, 0.1, 0.6),
                      [](double t, int) { return 4 * std::sin(5 * t); });
    const Vec3 p0 = pose(motion.kin(), y.axes).p;
    Matrix J(6, 3);
    frame_jacobian<double>(motion.kin(), y.axes, J);
    const Vec3 v0 = J.bottomRows<3>() * motion.qd();
    // In table axes at rest x'' = omega^2 x + 2 omega y',  y'' = omega^2 y - 2 omega x'.
    const Vector qdd = motion.response().qdd;
    CHECK(qdd(1) == Approx(omega * omega * 0.5 + 2 * omega * 0.6).epsilon(1e-13));
    CHECK(qdd(2) == Approx(omega * omega * -0.4 - 2 * omega * 0.1).epsilon(1e-13));
    for (int i = 0; i < 4; ++i) {
        motion.advance(0.5, 500);
        CHECK((pose(motion.kin(), y.axes).p - p0 - motion.time() * v0).norm() < 1e-9);
    }
    // omega + integral of 4 sin 5t
    CHECK(motion.qd()(0) == Approx(omega + 0.8 * (1 - std::cos(10.0))).epsilon(1e-10));
}

TEST_CASE("oscillator: a damped spring swings about its rest position in closed form, sliding and turning",
          "[analytic]") {
    const double m = 1.8, k = 45, d = 1.5, rest = 0.2, start = 0.5;
    const double decay = d / (2 * m), omega = std::sqrt(k / m - decay * decay);
    for (const JointKind kind : {JointKind::prismatic, JointKind::revolute}) {
        Tree tree;
        const RigidInertia body = kind == JointKind::prismatic ? mass_of(m) : wheel(1, {m, m, m});
        const Link link =
            add_joint(tree, {.name = "oscillator", .kind = kind, .axis = Vec3(2, 3, 6) / 7, .inertia = body});
        ForceSet set;
        set.add_spring("spring", link.body, k, d, rest);
        const System system(tree, set);
        Simulation motion(system, Vector::Constant(1, start), Vector::Zero(1));
        for (int i = 0; i < 4; ++i) {
            motion.advance(0.3, 300);
            const double t = motion.time(), x0 = start - rest;
            const double x = std::exp(-decay * t) * x0 * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
            CHECK(motion.q()(0) - rest == Approx(x).margin(1e-10));
        }
    }
}

TEST_CASE("oscillator: a hanging mass swings about its static sag m g / k", "[analytic]") {
    const double m = 1.8, k = 45, gravity = units::standard_gravity, omega = std::sqrt(k / m);
    Tree tree;
    const Link link = add_joint(tree, {.name = "hoist", .kind = JointKind::prismatic, .inertia = mass_of(m)});
    ForceSet set;
    set.add_spring("spring", link.body, k);
    set.set_gravity(Vec3(0, 0, -gravity));
    const System system(tree, set);
    Simulation motion(system, Vector::Zero(1), Vector::Zero(1));
    motion.advance(0.9, 900);
    CHECK(motion.q()(0) == Approx(-m * gravity / k * (1 - std::cos(omega * 0.9))).epsilon(1e-9));
}

TEST_CASE("oscillator: masses in a row between two walls have 2 sqrt(k/m) sin(j pi / 2(n+1))", "[analytic]") {
    const int n = 5;
    const double m = 0.6, k = 80;
    Tree tree;
    ForceSet set;
    FrameId at = Tree::base();
    LinearLaw wall{"far wall", {}, Matrix::Constant(n, n, k)};  // rank one: k (q1 + ... + qn)^2 / 2
    for (int i = 0; i < n; ++i) {
        const Link link = add_joint(
            tree, {.name = text("mass ", i), .inboard = at, .kind = JointKind::prismatic, .inertia = mass_of(m)});
        at = link.axes;
        set.add_spring(text("spring ", i), link.body, k);
        wall.coordinates.push_back(link.body);
    }
    set.add_law(wall);
    const System system(tree, set);
    Workspace workspace(system.model);
    const Vector zero = Vector::Zero(n);
    const Kinematics kin = kinematics(system.model, zero, workspace);
    Matrix g(n, n);
    metric(kin, g);
    ForceDerivatives d;
    system.forces.derivatives({{.q = zero, .qd = zero}, kin}, d);
    const Vector squares = Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>(d.elastic, g).eigenvalues();
    for (int j = 1; j <= n; ++j)
        CHECK(std::sqrt(squares(j - 1)) ==
              Approx(2 * std::sqrt(k / m) * std::sin(j * pi / (2 * (n + 1)))).epsilon(1e-12));
}

namespace {

// Rotor on a shaft, a flywheel on the twist of the shaft, and a generator that turns with n1 q1' + n2 q2'.
struct DriveTrain {
    explicit DriveTrain(double flywheel_, CoordinateRole role = free_role, double stiffness = 0)
        : flywheel(flywheel_), system(make(role, stiffness)) {}
    System make(CoordinateRole role, double stiffness) const {
        Tree tree;
        const Link hub = add_joint(tree, {.name = "hub", .inertia = wheel(5, {rotor, rotor, rotor})});
        const Link twist = add_joint(
            tree,
            {.name = "twist", .inboard = hub.axes, .inertia = wheel(0, {flywheel, flywheel, flywheel}), .role = role});
        tree.add_armature({"generator", generator, {{hub.body, n1}, {twist.body, n2}}});
        ForceSet set;
        if (stiffness > 0) set.add_spring("shaft", twist.body, stiffness);
        return {tree, set};
    }
    Eigen::Matrix2d metric_by_hand() const {
        const double m12 = flywheel + generator * n1 * n2;
        Eigen::Matrix2d M;
        M << rotor + flywheel + generator * n1 * n1, m12, m12, flywheel + generator * n2 * n2;
        return M;
    }
    static constexpr double rotor = 40, generator = 0.03, n1 = 23, n2 = 23;
    double flywheel;
    System system;
};

}  // namespace

TEST_CASE("gears: two coordinates with one geared armature obey the 2 x 2 equations written by hand", "[analytic]") {
    Random random(2);
    for (const double flywheel : {3.0, 0.0}) {  // without it only the armature gives the twist inertia
        const DriveTrain train(flywheel);
        const Eigen::Matrix2d M = train.metric_by_hand();
        const double det = M.determinant();
        ForwardDynamics forward(train.system.model);
        Workspace workspace(train.system.model);
        Matrix g(2, 2);
        for (int i = 0; i < 20; ++i) {
            const Vector q = random_state(random, 2), qd = random_state(random, 2), Q = random_state(random, 2, 10);
            const Kinematics kin = kinematics(train.system.model, q, workspace);
            metric(kin, g);
            CHECK((g - M).cwiseAbs().maxCoeff() < 1e-13);
            CHECK(kinetic_energy(kin, qd) == Approx(0.5 * qd.dot(M * qd)).epsilon(1e-13));
            Vector qdd(2), actuator(2), tau(2);
            forward.solve(kin, qd, Q, qdd, actuator);
            CHECK(qdd(0) == Approx((M(1, 1) * Q(0) - M(0, 1) * Q(1)) / det).epsilon(1e-11));
            CHECK(qdd(1) == Approx((M(0, 0) * Q(1) - M(0, 1) * Q(0)) / det).epsilon(1e-11));
            CHECK(actuator.isZero(0));
            inverse_dynamics<double>(kin, qd, qdd, tau);
            CHECK((tau - Q).norm() < 1e-11 * Q.norm());
        }
    }
}

TEST_CASE("gears: torsion of a free drive train has omega^2 = k (1 / I_rotor + 1 / n^2 I_generator)", "[analytic]") {
    const double k = 5e3;
    const DriveTrain train(0, free_role, k);
    const double slow_side = DriveTrain::n1 * DriveTrain::n1 * DriveTrain::generator;
    const double omega = std::sqrt(k * (1 / DriveTrain::rotor + 1 / slow_side));
    // The mode: rotor and generator turn against one another, momentum zero.
    const double share = slow_side / (DriveTrain::rotor + slow_side), twist = 0.01;
    Simulation motion(train.system, Eigen::Vector2d(-share * twist, twist), Vector::Zero(2));
    motion.advance(0.4 * 2 * pi / omega, 500);
    CHECK(motion.q()(1) == Approx(twist * std::cos(0.8 * pi)).epsilon(1e-9));
    CHECK(motion.q()(0) == Approx(-share * twist * std::cos(0.8 * pi)).epsilon(1e-9));
}

TEST_CASE("gears: a driven twist loads the hub through the armature, its drive exerts the row of the metric",
          "[analytic]") {
    const DriveTrain train(3.0, driven_role);
    const Eigen::Matrix2d M = train.metric_by_hand();
    ForwardDynamics forward(train.system.model);
    Workspace workspace(train.system.model);
    const Vector zero = Vector::Zero(2), Q = Eigen::Vector2d(70, 11);
    const double twist = 1.7;
    Vector qdd(2), actuator(2);
    qdd << 0, twist;
    forward.solve(kinematics(train.system.model, zero, workspace), zero, Q, qdd, actuator);
    const double hub = (Q(0) - M(0, 1) * twist) / M(0, 0);
    CHECK(qdd(0) == Approx(hub).epsilon(1e-12));
    CHECK(qdd(1) == twist);
    CHECK(actuator(0) == 0);
    CHECK(actuator(1) == Approx(M(1, 0) * hub + M(1, 1) * twist - Q(1)).epsilon(1e-12));
}

TEST_CASE("drive: an unbalanced rotor with prescribed angle needs J psi'' + m g s cos psi", "[analytic]") {
    const double m = 3, s = 0.2, J = 0.5, gravity = units::standard_gravity, omega = 2, alpha = 0.7;
    Tree tree;
    RigidInertia rotor = wheel(m, {J, J, J});
    rotor.com = Vec3(s, 0, 0);
    add_joint(tree, {.name = "rotor", .axis = -Vec3::UnitY(), .inertia = rotor, .role = driven_role});  // lifts x to z
    ForceSet set;
    set.set_gravity(Vec3(0, 0, -gravity));
    const System system(tree, set);
    Simulation motion(system, Vector::Zero(1), Vector::Constant(1, omega), [&](double, int) { return alpha; });
    for (int i = 0; i < 5; ++i) {
        const double t = motion.time(), psi = omega * t + alpha * t * t / 2;
        CHECK(motion.q()(0) == Approx(psi).margin(1e-12));
        CHECK(motion.response().actuator(0) ==
              Approx((J + m * s * s) * alpha + m * gravity * s * std::cos(psi)).epsilon(1e-12));
        motion.advance(0.6, 10);
    }
}

TEST_CASE("drive: yawing a spinning two-bladed rotor takes gyroscopic torques about three axes", "[analytic]") {
    // Rotor axis x, moments (C, B, A) at azimuth 0; yaw about z with Omega, spin with omega, tilt locked. From
    // L = J(psi) (omega, 0, Omega) in yawing axes and dL/dt + Omega z x L = torque:
    const double C = 9, B = 1.5, A = 8, omega = 3, Omega = 0.4;
    Tree tree;
    const Link yaw = add_joint(tree, {.name = "yaw", .role = driven_role});
    const Link tilt =
        add_joint(tree, {.name = "tilt", .inboard = yaw.axes, .axis = Vec3::UnitY(), .role = driven_role});
    add_joint(tree, {.name = "spin",
                     .inboard = tilt.axes,
                     .axis = Vec3::UnitX(),
                     .inertia = wheel(100, {C, B, A}),
                     .role = driven_role});
    const System system(tree, {});
    for (const double psi : {0.0, 0.3, 1.2, 2.9}) {
        Simulation motion(system, Vec3(0.7, 0, psi), Vec3(Omega, 0, omega));
        const Vector torque = motion.response().actuator;
        CAPTURE(psi);
        CHECK(torque(0) == Approx((B - A) * std::sin(2 * psi) * omega * Omega).margin(1e-12));
        CHECK(torque(1) == Approx((C + (B - A) * std::cos(2 * psi)) * omega * Omega).margin(1e-12));
        CHECK(torque(2) == Approx(-(B - A) * std::sin(2 * psi) / 2 * Omega * Omega).margin(1e-12));
    }
}

TEST_CASE("forward dynamics: negative armatures over several coordinates, where the metric stays positive",
          "[analytic]") {
    // Two bodies about one axis with moments of inertia 3 and 1: without the armature g = [4 1; 1 1]. J = -2 on
    // s = (1, 1/2) takes [2 1; 1 1/2] from it: g = diag(2, 1/2).
    for (const bool with_single : {false, true}) {
        Tree tree;
        const BodyId inner = tree.add_body({.name = "inner", .inertia = {1, Vec3::Zero(), Vec3(2, 2, 3).asDiagonal()}});
        const BodyId outer = tree.add_body({.name = "outer",
                                            .inboard = tree.frame_of(inner),
                                            .inertia = {1, Vec3::Zero(), Vec3(1, 1, 1).asDiagonal()}});
        tree.add_armature({"taken", -2, {{inner, 1.0}, {outer, 0.5}}});
        if (with_single) tree.add_armature({"taken once more", -1, {{inner, 1.0}}});
        const Model model(tree);
        Workspace workspace(model);
        const Kinematics kin = kinematics(model, Vector::Constant(2, 0.3), workspace);
        Matrix g(2, 2);
        metric<double>(kin, g);
        CHECK((g - Vec3(with_single ? 1 : 2, 0.5, 0).head<2>().asDiagonal().toDenseMatrix()).norm() < 1e-15);
        Vector qdd(2), actuator(2);
        ForwardDynamics(model).solve(kin, Vector::Zero(2), Vector::Ones(2), qdd, actuator);
        CHECK(qdd(0) == Approx(with_single ? 1 : 0.5).epsilon(1e-13));
        CHECK(qdd(1) == Approx(2).epsilon(1e-13));
        // The inner body driven: the outer one alone, g_ff = 1/2, and g_df = 0.
        qdd << 3, 0;
        ForwardDynamics(model, {true, false}).solve(kin, Vector::Zero(2), Vector::Ones(2), qdd, actuator);
        CHECK(qdd(1) == Approx(2).epsilon(1e-13));
        CHECK(actuator(0) == Approx(3 * g(0, 0) - 1).epsilon(1e-13));
    }
}
