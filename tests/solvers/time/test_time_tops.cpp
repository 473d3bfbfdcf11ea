// Tops in time: closed forms along the whole motion, near and through the singularity of the joint coordinates.
#include "mbs/base/units.hpp"
#include "solvers/atlas/atlas.hpp"
#include "tests/oracles/heavy_top.hpp"
#include "tests/oracles/torque_free_top.hpp"
#include "tests/solvers/time/integrated_systems.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/tree_tools.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

// Global over local error: some thousand steps; the method of second order is given 1e-8 where others have 1e-10.
struct Accuracy {
    Method method;
    double tolerance, error;
};
constexpr Accuracy accuracies[] = {{Method::bdf, 1e-10, 5e-7},
                                   {Method::adams, 1e-10, 1e-7},
                                   {Method::dirk, 1e-10, 5e-9},
                                   {Method::erk, 1e-10, 5e-9},
                                   {Method::generalised_alpha, 1e-8, 1e-4}};

// A body on three revolute joints about axes of the frame `start`, with massless bodies between them.
System on_three_axes(const Mat3& start, const std::array<int, 3>& axes, const RigidInertia& body,
                     const std::string& chart = "") {
    Tree tree;
    FrameId at = tree.add_frame(Tree::base(), Placement::rotation(start), "start");
    const char* names[] = {"outer", "middle", "inner"};
    for (std::size_t i = 0; i < 3; ++i) {
        Joint joint{.name = chart + names[i], .inboard = at, .axis = Vec3::Unit(axes[i])};
        if (i == 2) joint.inertia = body;
        at = add_joint(tree, joint).axes;
    }
    tree.add_frame(at, {}, "body");
    return {tree, {}};
}

Mat3 attitude(const System& system, const Vector& q) {
    Workspace workspace(system.model);
    return pose(kinematics(system.model, q, workspace), system.model.frame("body")).R;
}

Momentum momentum_of(const System& system, const Integrator& at) {
    Workspace workspace(system.model);
    return momentum(kinematics(system.model, at.state().q, workspace), at.state().qd);
}

// Asymmetric tops that circulate about the axis of greatest and of least inertia; H lies along z.
const Vec3 moments(1, 2, 2.8);
const oracles::FreeAsymmetricTop about_3(moments, 0.5, 1.7), about_1(moments, 1.9, 0.4);
const RigidInertia tumbling_body{3, Vec3::Zero(), moments.asDiagonal()};

// Joint axes x, y, z are singular where the body's z axis meets the x axis of `start`. These are placed so that the
// path of the body's z axis passes the x axis at a distance (rad) at the time given, in the direction of the y axis.
Mat3 passing(const oracles::FreeAsymmetricTop& top, double distance, double time) {
    const Mat3 R = top.attitude(time);
    const Vec3 z = R.col(2), sideways = (R * top.angular_velocity(time)).cross(z).normalized();
    Mat3 start;
    start.col(0) = std::cos(distance) * z + std::sin(distance) * z.cross(sideways);
    start.col(1) = sideways;
    start.col(2) = start.col(0).cross(start.col(1));
    return start;
}

// Angles and rates about x, y, z for an attitude seen from `start`.
ChartState cardan_angles(const Mat3& M, const Vec3& omega_body) {
    ChartState s{Vector(3), Vector(3)};
    s.q << std::atan2(-M(1, 2), M(2, 2)), std::asin(M(0, 2)), std::atan2(-M(0, 1), M(0, 0));
    const Vec3 omega = M * omega_body;  // about x, then y carried by x, then the body's own z
    Mat3 axes;
    axes << Vec3::UnitX(), rot_x(s.q(0)) * Vec3::UnitY(), M.col(2);
    s.qd = axes.inverse() * omega;
    return s;
}
ChartState tumbling_start(const oracles::FreeAsymmetricTop& top, const Mat3& start) {
    return cardan_angles(start.transpose() * top.attitude(0), top.angular_velocity(0));
}

}  // namespace

TEST_CASE("time: the free asymmetric top keeps to Jacobi's functions with every method", "[solvers][time][analytic]") {
    const oracles::FreeAsymmetricTop& top = about_3;
    const Mat3 start = passing(top, 1.0, 0.3 * top.period());
    const System system = on_three_axes(start, {0, 1, 2}, tumbling_body);
    const ChartState s = tumbling_start(top, start);
    for (const Accuracy& a : accuracies) {
        CAPTURE(static_cast<int>(a.method));
        Integrator integrator(system, {}, 0, s.q, s.qd, equal_tolerances(a.method, a.tolerance));
        for (int i = 1; i <= 6; ++i) {
            const double t = 0.5 * i * top.period();
            REQUIRE(integrator.advance(t).reached());
            CHECK((attitude(system, integrator.state().q) - top.attitude(t)).norm() < a.error);
        }
        CHECK(std::abs(integrator.energy().error) < a.error);
    }
}

TEST_CASE("time: near the singularity of the joints the top keeps attitude, energy and momentum",
          "[solvers][time][analytic]") {
    const oracles::FreeAsymmetricTop& top = about_3;
    const double meeting = 1.3 * top.period();
    for (const double distance : {1e-2, 1e-3, 1e-4}) {
        const Mat3 start = passing(top, distance, meeting);
        const System system = on_three_axes(start, {0, 1, 2}, tumbling_body);
        const ChartState s = tumbling_start(top, start);
        for (const Accuracy& a : accuracies) {
            // The least eigenvalue of the metric is as the square of the distance: so much of rounding is left.
            const double allowed = a.error + 1e-16 / (distance * distance);
            CAPTURE(distance, static_cast<int>(a.method));
            Integrator integrator(system, {}, 0, s.q, s.qd, equal_tolerances(a.method, a.tolerance));
            REQUIRE(integrator.advance(meeting).reached());
            CHECK(std::abs(std::abs(std::cos(integrator.state().q(1))) - std::sin(distance)) <
                  a.error + 1e-2 * distance);
            REQUIRE(integrator.advance(2 * meeting).reached());
            const double error = (attitude(system, integrator.state().q) - top.attitude(integrator.time())).norm();
            const Momentum kept = momentum_of(system, integrator);
            CAPTURE(error, integrator.statistics().steps, integrator.energy().error);
            CHECK(error < allowed);
            CHECK((kept.angular - top.angular_momentum() * Vec3::UnitZ()).norm() < allowed);
            CHECK(std::abs(integrator.energy().error) < allowed);
        }
    }
}

TEST_CASE("time: aimed at the singularity, the steps pass it and the balance of energy shows what was lost",
          "[solvers][time][analytic]") {
    const oracles::FreeAsymmetricTop& top = about_3;
    const double meeting = 1.3 * top.period();
    const Mat3 start = passing(top, 0, meeting);
    const System system = on_three_axes(start, {0, 1, 2}, tumbling_body);
    const ChartState s = tumbling_start(top, start);
    for (const Method method : methods) {
        Integrator integrator(system, {}, 0, s.q, s.qd, equal_tolerances(method, 1e-4));
        REQUIRE(integrator.advance(2 * meeting).reached());
        const double error = (attitude(system, integrator.state().q) - top.attitude(2 * meeting)).norm();
        CAPTURE(static_cast<int>(method), error, integrator.energy().error, integrator.statistics().steps);
        CHECK(error < 3e-2);
        CHECK(error < 30 * std::abs(integrator.energy().error) + 1e-4);
        CHECK(integrator.statistics().steps < 2000);
    }
}

TEST_CASE("time: in the singularity implicit methods refuse to start and name the coordinate",
          "[solvers][time][property]") {
    const System system = on_three_axes(Mat3::Identity(), {0, 1, 2}, tumbling_body);
    const Vector q = Vec3(0.2, pi / 2, 0.1);
    for (const Vec3& rates : {Vec3(0, 0, 0), Vec3(0.3, 0.4, 0.5)})
        for (const Method method : {Method::bdf, Method::dirk}) {
            Integrator integrator(system, {}, 0, q, rates, equal_tolerances(method, 1e-8));
            const Advance advance = integrator.advance(1);
            CAPTURE(advance.message);
            CHECK(advance.end == Advance::End::failed);
            CHECK(advance.message.find("metric is not positive definite: coordinate 'outer'") != std::string::npos);
        }
}

TEST_CASE("time: with a change of chart the top tumbles through the singularity of either chart",
          "[solvers][time][analytic]") {
    // Joints about x, y, z and about y, x, z: where the first are singular, the second have perpendicular axes.
    const oracles::FreeAsymmetricTop& top = about_1;
    const double meeting = 1.3 * top.period();
    const Mat3 start = passing(top, 0, meeting);
    const System xyz = on_three_axes(start, {0, 1, 2}, tumbling_body, "first ");
    const System yxz = on_three_axes(start, {1, 0, 2}, tumbling_body, "second ");
    const ChartState s = tumbling_start(top, start);
    for (const Accuracy& a : accuracies) {
        const IntegrationOptions options = equal_tolerances(a.method, a.tolerance);
        AtlasIntegrator atlas({{&xyz, {}, options}, {&yxz, {}, options}}, "body", 0, s.q, s.qd);
        double largest = 0;
        for (int i = 1; i <= 8; ++i) {
            const double t = i * meeting / 4;
            REQUIRE(atlas.advance(t).reached());
            CHECK(atlas.integrator().time() == t);
            largest =
                std::max(largest, (attitude(atlas.system(), atlas.integrator().state().q) - top.attitude(t)).norm());
        }
        const Momentum kept = momentum_of(atlas.system(), atlas.integrator());
        const IntegrationStatistics statistics = atlas.integrator().statistics();
        CAPTURE(static_cast<int>(a.method), largest, atlas.changes(), statistics.steps);
        CHECK(largest < 10 * a.error);
        CHECK((kept.angular - top.angular_momentum() * Vec3::UnitZ()).norm() < a.error);
        CHECK(std::abs(atlas.integrator().energy().error) < a.error);  // since the first start
        CHECK(atlas.changes() > 5);
        CHECK(statistics.restarts == atlas.changes());
    }
}

namespace {

// Heavy top in Euler angles: psi about the vertical, theta about x, phi about its own axis. The model is made at an
// inclination: at q = 0 the metric must be regular.
struct HeavyTop {
    static constexpr double mass = 1.5, height = 0.3, transverse = 0.4, axial = 0.35, gravity = units::standard_gravity,
                            inclined = 0.7;
    oracles::HeavySymmetricTop oracle{transverse + mass * height * height, axial, mass* gravity* height};

    System system() const {
        Tree tree;
        const Link precession = add_joint(tree, {.name = "precession"});
        const FrameId at = tree.add_frame(precession.axes, Placement::rotation(rot_x(inclined)), "inclined");
        const Link nutation = add_joint(tree, {.name = "nutation", .inboard = at, .axis = Vec3::UnitX()});
        const RigidInertia body{mass, Vec3(0, 0, height), Vec3(transverse, transverse, axial).asDiagonal()};
        add_joint(tree, {.name = "spin", .inboard = nutation.axes, .inertia = body});
        ForceSet forces;
        forces.set_gravity({0, 0, -gravity});
        return {tree, forces};
    }
    Integrator start(const System& system, double theta, double psi_dot, double omega3, const Accuracy& a) const {
        return {system,
                {},
                0,
                Vec3(0, theta - inclined, 0),
                Vec3(psi_dot, 0, omega3 - psi_dot * std::cos(theta)),
                equal_tolerances(a.method, a.tolerance)};
    }
};

}  // namespace

TEST_CASE("time: the heavy top precesses at both steady rates with every method", "[solvers][time][analytic]") {
    const HeavyTop top;
    const double theta = 0.7, omega3 = 25;
    const System system = top.system();
    const auto rates = top.oracle.steady_precession(theta, omega3);
    REQUIRE(rates.has_value());
    for (const double psi_dot : {rates->slow, rates->fast}) {
        const double t = 2 * pi / psi_dot;  // a turn
        for (const Accuracy& a : accuracies) {
            Integrator integrator = top.start(system, theta, psi_dot, omega3, a);
            REQUIRE(integrator.advance(t).reached());
            const Vector& q = integrator.state().q;
            CAPTURE(static_cast<int>(a.method), psi_dot, q(0) - 2 * pi, q(1) - theta + top.inclined);
            CHECK(std::abs(q(1) + top.inclined - theta) < a.error);
            CHECK(std::abs(q(0) - 2 * pi) < a.error);
        }
    }
}

TEST_CASE("time: the heavy top nutates by elliptic functions, with cusps, loops, and close to the upright",
          "[solvers][time][analytic]") {
    // Passing the upright at 2 m/s per m of height and 1e-2 ... 1e-4 rad away, where Euler's angles are nearly
    // singular.
    struct Case {
        double theta, psi_dot, omega3;
    };
    const HeavyTop top;
    const double slow = 0.5 * top.oracle.min_spin(0);
    const System system = top.system();
    for (const Case& c :
         {Case{0.6, 0, 18}, Case{0.6, -0.5, 18}, Case{1e-2, 2e2, slow}, Case{1e-3, 2e3, slow}, Case{1e-4, 2e4, slow}}) {
        const oracles::HeavySymmetricTop::State start{c.theta, 0, c.psi_dot, c.omega3};
        const auto constants = top.oracle.conserved(start);
        const auto nutation = top.oracle.nutation(start);
        REQUIRE(nutation.upper == Approx(std::cos(c.theta)).epsilon(1e-12));
        for (const Accuracy& a : accuracies) {
            Integrator integrator = top.start(system, c.theta, c.psi_dot, c.omega3, a);
            double of_cosine = 0, of_rate = 0;
            for (int i = 1; i <= 8; ++i) {
                const double t = i * nutation.period() / 4.5;
                REQUIRE(integrator.advance(t).reached());
                const DynamicState& now = integrator.state();
                of_cosine = std::max(of_cosine, std::abs(std::cos(top.inclined + now.q(1)) -
                                                         nutation.cos_theta(t + nutation.period() / 2)));
                const double rate = top.oracle.precession_rate(constants, top.inclined + now.q(1));
                of_rate = std::max(of_rate, std::abs(now.qd(0) - rate) / (1 + std::abs(rate)));
            }
            CAPTURE(c.theta, static_cast<int>(a.method), of_cosine, of_rate, integrator.statistics().steps);
            const double allowed = a.error + 1e-16 / (c.theta * c.theta);  // as above
            CHECK(of_cosine < allowed);
            CHECK(of_rate < allowed);
            CHECK(std::abs(integrator.energy().error) < allowed);
        }
    }
}
