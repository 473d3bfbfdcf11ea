// Pendulums against elliptic functions and equations written out.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/units.hpp"
#include "tests/oracles/heavy_top.hpp"
#include "tests/oracles/pendulum.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/point_masses.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/simulation.hpp"
#include "tests/support/tree_tools.hpp"

namespace cardan::testing::pendulums {

namespace {

constexpr double gravity = units::standard_gravity;

ForceSet weight() {
    ForceSet set;
    set.set_gravity(Vec3(0, 0, -gravity));
    return set;
}

// A rigid body on an axis that is inclined to the horizontal by `tilt`.
struct PlanarPendulum {
    explicit PlanarPendulum(double tilt) : system(make(tilt)) {
        omega0 = std::sqrt(mass * gravity * std::cos(tilt) * arm / (moment + mass * arm * arm));
    }
    System make(double tilt) {
        Tree tree;
        const FrameId bearing = tree.add_frame(Tree::base(), {rot_x(tilt), Vec3(1, 2, 3)}, "bearing");
        RigidInertia body{mass, Vec3(0, 0.4, -arm), Mat3::Zero()};  // 0.4 m along the axis: no difference
        body.J.diagonal() << 0.1, moment, 0.05;
        add_joint(tree, {.name = "swing", .inboard = bearing, .axis = Vec3::UnitY(), .inertia = body});
        return {tree, weight()};
    }
    static constexpr double mass = 1.7, arm = 0.6, moment = 0.13;
    System system;
    double omega0;
};

}  // namespace

TEST_CASE("pendulum: angle, rate and period of wide swings by elliptic functions, on level and on tilted bearings",
          "[analytic]") {
    for (const double tilt : {0.0, 0.5})
        for (const double amplitude : {0.2, 1.5, 3.0}) {
            const PlanarPendulum pendulum(tilt);
            const oracles::SwingingPendulum exact(pendulum.omega0, amplitude);
            Simulation motion(pendulum.system, Vector::Constant(1, amplitude), Vector::Zero(1));
            CAPTURE(tilt, amplitude);
            const double t = 0.3 * exact.period();
            motion.advance(t, 1000);
            CHECK(motion.q()(0) == Approx(exact.angle(t)).margin(1e-9));
            CHECK(motion.qd()(0) == Approx(exact.rate(t)).margin(1e-9));
            motion.advance(exact.period() - t, 2500);
            CHECK(motion.q()(0) == Approx(amplitude).epsilon(1e-9));
            CHECK(motion.qd()(0) == Approx(0).margin(1e-8));
        }
}

TEST_CASE("pendulum: over the top, one turn takes the time by the elliptic integral", "[analytic]") {
    const PlanarPendulum pendulum(0);
    const oracles::RevolvingPendulum exact(pendulum.omega0, 2.1 * pendulum.omega0);
    Simulation motion(pendulum.system, Vector::Zero(1), Vector::Constant(1, 2.1 * pendulum.omega0));
    const double t = 0.4 * exact.period();
    motion.advance(t, 1000);
    CHECK(motion.q()(0) == Approx(exact.angle(t)).epsilon(1e-9));
    CHECK(motion.qd()(0) == Approx(exact.rate(t)).epsilon(1e-9));
    motion.advance(exact.period() - t, 1500);
    CHECK(motion.q()(0) == Approx(2 * pi).epsilon(1e-9));
}

TEST_CASE("spherical pendulum: on two crossed axes it goes round a cone with omega^2 = g / (l cos theta)",
          "[analytic]") {
    const double length = 0.8, theta = 0.6, omega = std::sqrt(gravity / (length * std::cos(theta)));
    Tree tree;
    const Link outer = add_joint(tree, {.name = "about x", .axis = Vec3::UnitX()});
    const RigidInertia bob = point_mass(2, Vec3(0, 0, -length));
    const Link inner =
        add_joint(tree, {.name = "about y", .inboard = outer.axes, .axis = Vec3::UnitY(), .inertia = bob});
    const FrameId at_bob = tree.add_frame(inner.axes, Placement::translation(bob.com), "bob");
    const System system(tree, weight());
    // Starts at azimuth 0 with a horizontal velocity in y.
    Simulation motion(system, Eigen::Vector2d(0, -theta), Eigen::Vector2d(omega * std::tan(theta), 0));
    for (int i = 1; i <= 8; ++i) {
        motion.advance(2 * pi / omega / 8, 300);
        const double psi = i * pi / 4;
        const Vec3 expected =
            length * Vec3(std::sin(theta) * std::cos(psi), std::sin(theta) * std::sin(psi), -std::cos(theta));
        CHECK((pose(motion.kin(), at_bob).p - expected).norm() < 1e-9);
    }
}

TEST_CASE("spherical pendulum: between two heights by elliptic functions", "[analytic]") {
    const double mass = 2, length = 0.8, theta = pi - 0.9;  // from the upward vertical
    Tree tree;
    const Link azimuth = add_joint(tree, {.name = "azimuth"});
    const RigidInertia bob = point_mass(mass, length * Vec3(std::sin(theta), 0, std::cos(theta)));
    const Link height =
        add_joint(tree, {.name = "height", .inboard = azimuth.axes, .axis = Vec3::UnitY(), .inertia = bob});
    const FrameId at_bob = tree.add_frame(height.axes, Placement::translation(bob.com), "bob");
    const System system(tree, weight());

    // A heavy top that does not spin. It starts from its highest position: slower than on the cone.
    const oracles::HeavySymmetricTop top(mass * length * length, 1, mass * gravity * length);
    const double conical = std::sqrt(-gravity / (length * std::cos(theta)));
    for (const double rate : {0.3 * conical, 0.9 * conical}) {
        const oracles::HeavySymmetricTop::State start{theta, 0, rate, 0};
        const auto nutation = top.nutation(start);
        REQUIRE(nutation.upper == Approx(std::cos(theta)).epsilon(1e-12));
        Simulation motion(system, Vector::Zero(2), Eigen::Vector2d(rate, 0));
        double lowest = 0;
        for (int i = 1; i <= 10; ++i) {
            motion.advance(nutation.period() / 10, 200);
            const double cosine = nutation.cos_theta(motion.time() + nutation.period() / 2);
            lowest = std::min(lowest, cosine);
            CHECK(pose(motion.kin(), at_bob).p(2) == Approx(length * cosine).epsilon(1e-9));
            CHECK(motion.qd()(0) == Approx(top.precession_rate(top.conserved(start), std::acos(cosine))).epsilon(1e-8));
        }
        CHECK(lowest < std::cos(theta) - 0.01);
    }
    // On the cone itself nothing accelerates.
    Simulation cone(system, Vector::Zero(2), Eigen::Vector2d(conical, 0));
    CHECK(cone.response().qdd.norm() < 1e-13 * conical * conical);
}

namespace {

// Two point masses on massless rods in a plane; q: first angle, second angle relative to the first.
struct DoublePendulum {
    DoublePendulum(double m1_, double m2_, double l1_, double l2_)
        : m1(m1_), m2(m2_), l1(l1_), l2(l2_), system(make()) {}
    System make() const {
        Tree tree;
        const Link first =
            add_joint(tree, {.name = "first", .axis = Vec3::UnitY(), .inertia = point_mass(m1, Vec3(0, 0, -l1))});
        const FrameId elbow = tree.add_frame(first.axes, Placement::translation(Vec3(0, 0, -l1)), "elbow");
        add_joint(
            tree,
            {.name = "second", .inboard = elbow, .axis = Vec3::UnitY(), .inertia = point_mass(m2, Vec3(0, 0, -l2))});
        return {tree, weight()};
    }
    // Accelerations of the absolute angles: Landau and Lifshitz, Mechanics, section 5, problem 1, by Lagrange.
    Eigen::Vector2d accelerations(double t1, double t2, double w1, double w2) const {
        const double c = std::cos(t1 - t2), s = std::sin(t1 - t2);
        Eigen::Matrix2d M;
        M << (m1 + m2) * l1 * l1, m2 * l1 * l2 * c, m2 * l1 * l2 * c, m2 * l2 * l2;
        const Eigen::Vector2d rhs(-m2 * l1 * l2 * s * w2 * w2 - (m1 + m2) * gravity * l1 * std::sin(t1),
                                  m2 * l1 * l2 * s * w1 * w1 - m2 * gravity * l2 * std::sin(t2));
        const double det = M(0, 0) * M(1, 1) - M(0, 1) * M(1, 0);
        return {(M(1, 1) * rhs(0) - M(0, 1) * rhs(1)) / det, (M(0, 0) * rhs(1) - M(1, 0) * rhs(0)) / det};
    }
    double m1, m2, l1, l2;
    System system;
};

}  // namespace

TEST_CASE("double pendulum: the accelerations are those of Lagrange's equations written out", "[analytic]") {
    Random random(1);
    const DoublePendulum pendulum(1.3, 0.7, 0.9, 1.4);
    for (int i = 0; i < 100; ++i) {
        const Vector q = random_state(random, 2, pi), qd = random_state(random, 2, 5);
        const Eigen::Vector2d expected = pendulum.accelerations(q(0), q(0) + q(1), qd(0), qd(0) + qd(1));
        const Vector qdd = Simulation(pendulum.system, q, qd).response().qdd;
        CHECK(qdd(0) == Approx(expected(0)).epsilon(1e-11).margin(1e-11));
        CHECK(qdd(0) + qdd(1) == Approx(expected(1)).epsilon(1e-11).margin(1e-11));
    }
}

TEST_CASE("double pendulum: small oscillations of equal links have omega^2 = (2 -+ sqrt 2) g / l", "[analytic]") {
    const double length = 0.7;
    const DoublePendulum pendulum(1.1, 1.1, length, length);
    const Model& model = pendulum.system.model;
    Workspace workspace(model);
    const Vector zero = Vector::Zero(2);
    const Kinematics kin = kinematics(model, zero, workspace);
    Matrix g(2, 2);
    metric(kin, g);
    ForceDerivatives d;
    pendulum.system.forces.derivatives({{.q = zero, .qd = zero}, kin}, d);
    const Vector squares = Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>(d.gravity, g).eigenvalues();
    CHECK(squares(0) == Approx((2 - std::sqrt(2)) * gravity / length).epsilon(1e-13));
    CHECK(squares(1) == Approx((2 + std::sqrt(2)) * gravity / length).epsilon(1e-13));
}

}  // namespace cardan::testing::pendulums
