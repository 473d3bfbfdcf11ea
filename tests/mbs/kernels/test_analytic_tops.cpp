// Tops on three revolute joints with massless bodies between them, against closed forms.
#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "tests/oracles/heavy_top.hpp"
#include "tests/oracles/torque_free_top.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/simulation.hpp"
#include "tests/support/tree_tools.hpp"

#include <array>

using namespace cardan;
using namespace cardan::testing;

namespace {

// A body on three revolute joints about axes of the frame `start`; it lies like `start` at q = 0.
Tree on_three_axes(const Mat3& start, const std::array<int, 3>& axes, const RigidInertia& body) {
    Tree tree;
    FrameId at = tree.add_frame(Tree::base(), Placement::rotation(start), "start");
    for (int i = 0; i < 3; ++i) {
        Joint joint{.name = i == 2   ? "body"
                            : i == 1 ? "middle"
                                     : "outer",
                    .inboard = at,
                    .axis = Vec3::Unit(entry(axes, i))};
        if (i == 2) joint.inertia = body;
        at = add_joint(tree, joint).axes;
    }
    return tree;
}

RigidInertia centred(const Vec3& moments) {
    return {3.0, Vec3::Zero(), moments.asDiagonal()};
}

Vec3 body_rates(Simulation& motion, FrameId frame) {
    Matrix J(6, 3);
    const Kinematics kin = motion.kin();
    frame_jacobian<double>(kin, frame, J);
    return pose(kin, frame).R.transpose() * (J.topRows<3>() * motion.qd());
}

}  // namespace

TEST_CASE("free symmetric top: attitude and angular velocity in closed form, rod and disc", "[analytic]") {
    for (const double axial : {0.7, 3.5}) {
        const Vec3 omega0(0.4, -0.3, 1.9);
        const oracles::FreeSymmetricTop top(2.0, axial, omega0);
        const System system(on_three_axes(top.attitude(0), {0, 1, 2}, centred({2.0, 2.0, axial})), {});
        Simulation motion(system, Vector::Zero(3), omega0);  // at q = 0 the rates are the body components
        const FrameId body = system.model.frame("body axes");
        for (int i = 0; i < 5; ++i) {
            motion.advance(0.8, 400);
            CHECK((pose(motion.kin(), body).R - top.attitude(motion.time())).cwiseAbs().maxCoeff() < 1e-9);
            CHECK((body_rates(motion, body) - top.angular_velocity(motion.time())).norm() < 1e-9);
        }
        CHECK(motion.kinetic_energy() == Approx(top.kinetic_energy()).epsilon(1e-10));
        const Momentum kept = momentum(motion.kin(), motion.qd());
        CHECK((kept.angular - top.angular_momentum() * Vec3::UnitZ()).norm() < 1e-9);
    }
}

TEST_CASE("free asymmetric top: angular velocity by Jacobi's functions on both sides of the separatrix", "[analytic]") {
    const Vec3 moments(1.0, 2.0, 2.8);
    for (const bool about_3 : {true, false}) {
        const double omega1 = about_3 ? 0.5 : 1.9, omega3 = about_3 ? 1.7 : 0.4;
        const oracles::FreeAsymmetricTop top(moments, omega1, omega3);
        REQUIRE(top.circulates_about_axis_3() == about_3);
        // The last joint takes the fast axis, so that the middle one stays away from a right angle.
        const std::array<int, 3> axes = about_3 ? std::array{0, 1, 2} : std::array{1, 2, 0};
        const System system(on_three_axes(Mat3::Identity(), axes, centred(moments)), {});
        Vector qd = Vector::Zero(3);
        for (int i = 0; i < 3; ++i) qd(i) = Vec3(omega1, 0, omega3)(entry(axes, i));
        Simulation motion(system, Vector::Zero(3), qd);
        const FrameId body = system.model.frame("body axes");
        for (int i = 0; i < 5; ++i) {
            motion.advance(top.period() / 4, 500);
            CHECK((body_rates(motion, body) - top.angular_velocity(motion.time())).norm() < 1e-9);
        }
    }
}

namespace {

// Heavy top in Euler angles: psi about the vertical, theta about x, phi about its own axis; q = 0 is inclined by theta.
struct HeavyTop {
    HeavyTop(double theta_, double omega3_) : theta(theta_), omega3(omega3_), system(make()) {}
    System make() const {
        Tree tree;
        const Link precession = add_joint(tree, {.name = "precession"});
        const FrameId inclined = tree.add_frame(precession.axes, Placement::rotation(rot_x(theta)), "inclined");
        const Link nutation = add_joint(tree, {.name = "nutation", .inboard = inclined, .axis = Vec3::UnitX()});
        const RigidInertia body{mass, Vec3(0, 0, height), Vec3(transverse, transverse, axial).asDiagonal()};
        add_joint(tree, {.name = "spin", .inboard = nutation.axes, .inertia = body});
        ForceSet set;
        set.set_gravity(Vec3(0, 0, -gravity));
        return {tree, set};
    }
    oracles::HeavySymmetricTop oracle() const {
        return {transverse + mass * height * height, axial, mass * gravity * height};
    }
    Simulation start(double psi_dot, double theta_dot) const {
        return {system, Vector::Zero(3), Vec3(psi_dot, theta_dot, omega3 - psi_dot * std::cos(theta))};
    }
    static constexpr double mass = 1.5, height = 0.3, transverse = 0.4, axial = 0.35, gravity = units::standard_gravity;
    double theta, omega3;
    System system;
};

}  // namespace

TEST_CASE("heavy top: at both rates of steady precession nothing accelerates", "[analytic]") {
    for (const double theta : {0.4, 1.2, 2.3}) {
        const HeavyTop top(theta, 25);
        const auto rates = top.oracle().steady_precession(theta, 25);
        REQUIRE(rates.has_value());
        for (const double psi_dot : {rates->slow, rates->fast}) {
            CAPTURE(theta, psi_dot);
            Simulation motion = top.start(psi_dot, 0);
            CHECK(motion.response().qdd.norm() < 1e-12 * (1 + psi_dot * psi_dot));
            // and off that rate the top does nutate
            Simulation off = top.start(1.1 * psi_dot, 0);
            CHECK(std::abs(off.response().qdd(1)) > 1e-2);
        }
        Simulation motion = top.start(rates->slow, 0);
        motion.advance(1.0, 2000);
        CHECK(motion.q()(1) == Approx(0).margin(1e-9));
        CHECK(motion.q()(0) == Approx(rates->slow).epsilon(1e-9));
    }
}

TEST_CASE("heavy top: nutation with cusps and with loops by elliptic functions", "[analytic]") {
    const double theta = 0.6, omega3 = 18;
    const HeavyTop top(theta, omega3);
    const oracles::HeavySymmetricTop exact = top.oracle();
    for (const double psi_dot : {0.0, -0.5}) {  // released; thrown backwards
        const oracles::HeavySymmetricTop::State start{theta, 0, psi_dot, omega3};
        const auto nutation = exact.nutation(start);
        REQUIRE(nutation.upper == Approx(std::cos(theta)).epsilon(1e-11));
        Simulation motion = top.start(psi_dot, 0);
        for (int i = 1; i <= 7; ++i) {
            motion.advance(nutation.period() / 7, 400);
            const double cosine = nutation.cos_theta(motion.time() + nutation.period() / 2);
            const double angle = theta + motion.q()(1);
            CHECK(std::cos(angle) == Approx(cosine).epsilon(1e-9));
            CHECK(motion.qd()(0) == Approx(exact.precession_rate(exact.conserved(start), angle)).margin(1e-8));
        }
        CHECK(motion.q()(1) == Approx(0).margin(1e-8));  // one period
        CHECK(nutation.upper - nutation.lower > 1e-3);
        CHECK(motion.energy() == Approx(exact.conserved(start).energy).epsilon(1e-10));
    }
}
