// Six Denavit-Hartenberg parameters per joint: poses to parameters and back, and trees described by them.
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/christoffel.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"

#include <Eigen/Geometry>

#include <array>

using namespace cardan;
using namespace cardan::testing;

namespace {

// The product Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r) by Eigen's transforms: the definition.
Placement product(double gamma, double b, double alpha, double d, double theta, double r) {
    using Eigen::AngleAxisd;
    const Eigen::Isometry3d T = Eigen::Translation3d(0, 0, 0) * AngleAxisd(gamma, Vec3::UnitZ()) *
                                Eigen::Translation3d(0, 0, b) * AngleAxisd(alpha, Vec3::UnitX()) *
                                Eigen::Translation3d(d, 0, 0) * AngleAxisd(theta, Vec3::UnitZ()) *
                                Eigen::Translation3d(0, 0, r);
    return {T.linear(), T.translation()};
}

double angle_difference(double a, double b) {
    return std::abs(std::remainder(a - b, 2 * pi));
}

}  // namespace

TEST_CASE("dh: six parameters and back give the same pose, parallel and antiparallel axes among them", "[property]") {
    Random random(1);
    std::array<double, 5> worst{};
    for (int i = 0; i < 2000; ++i) {
        const int kind = i % 5;
        Placement pose = random_placement(random);
        const Mat3 turn = rot_z(uniform(random, -pi, pi));
        const Mat3 half_turn = Vec3(1, -1, -1).asDiagonal();
        if (kind == 1) pose.R = turn;                                                    // parallel
        if (kind == 2) pose.R = turn * half_turn;                                        // antiparallel
        if (kind == 3) pose = {i % 2 ? turn : turn * half_turn, Vec3(0, 0, pose.p(2))};  // and on one line
        if (kind == 4) pose.R = turn * rot_x(pi / 2);                                    // at a right angle
        const DhParameters dh = dh_parameters(pose);
        const Placement back = dh.placement();
        const double sine = std::hypot(pose.R(0, 2), pose.R(1, 2));
        // b and r0 are of the size |p| / sine: so much cancels.
        const double loss = kind == 0 ? 1 + 1 / sine : 1.0;
        entry(worst, kind) = std::max({entry(worst, kind), max_abs(back.R - pose.R), max_abs(back.p - pose.p) / loss});
        REQUIRE(dh.alpha >= 0);
        REQUIRE(dh.alpha <= pi);
        if (sine == 0) {
            REQUIRE(dh.r0 == 0);
            REQUIRE(dh.b == pose.p(2));
        }
    }
    for (const double error : worst) CHECK(error < 2e-15);
}

TEST_CASE("dh: a pose and back gives the same parameters where they are unique", "[property]") {
    Random random(2);
    for (int i = 0; i < 2000; ++i) {
        DhParameters dh;
        dh.gamma = uniform(random, -pi, pi), dh.alpha = uniform(random, 0.1, pi - 0.1);
        dh.theta0 = uniform(random, -pi, pi);
        dh.b = uniform(random, -2, 2), dh.d = uniform(random, -2, 2), dh.r0 = uniform(random, -2, 2);
        const DhParameters back = dh_parameters(dh.placement());
        REQUIRE(angle_difference(back.gamma, dh.gamma) < 2e-14);
        REQUIRE(angle_difference(back.alpha, dh.alpha) < 2e-14);
        REQUIRE(angle_difference(back.theta0, dh.theta0) < 2e-14);
        REQUIRE(std::abs(back.b - dh.b) < 2e-12);
        REQUIRE(std::abs(back.d - dh.d) < 2e-12);
        REQUIRE(std::abs(back.r0 - dh.r0) < 2e-12);
    }
}

TEST_CASE("dh: nearly parallel axes lose no more than 1e-8 of the pose, whichever the angle", "[property]") {
    Random random(3);
    for (double sine = 0.1; sine > 1e-17; sine /= 3)
        for (int i = 0; i < 40; ++i) {
            const double alpha = i % 2 ? std::asin(sine) : pi - std::asin(sine);
            const Placement pose{rot_z(uniform(random, -pi, pi)) * rot_x(alpha) * rot_z(uniform(random, -pi, pi)),
                                 random_vector(random)};
            const Placement back = dh_parameters(pose).placement();
            CAPTURE(sine);
            REQUIRE(max_abs(back.R - pose.R) < 1.01e-8);
            REQUIRE(max_abs(back.p - pose.p) < 4e-8);
            if (sine > 1e-7) REQUIRE(max_abs(back.R - pose.R) < 1e-15);
            if (sine > 1e-7) REQUIRE(max_abs(back.p - pose.p) < 4e-16 * (3 + 1 / sine));
            REQUIRE(back.is_valid());
        }
}

TEST_CASE("dh: the placement is the product of its six elementary motions", "[analytic]") {
    Random random(4);
    for (int i = 0; i < 100; ++i) {
        const Vector x = random_state(random, 6, 3);
        const Placement pose = DhParameters{x(0), x(1), x(2), x(3), x(4), x(5)}.placement();
        const Placement expected = product(x(0), x(1), x(2), x(3), x(4), x(5));
        REQUIRE(max_abs(pose.R - expected.R) < 2e-15);
        REQUIRE(max_abs(pose.p - expected.p) < 4e-15);
    }
}

TEST_CASE("dh: with gamma = b = 0 it is the classical modified convention", "[analytic]") {
    // Craig, Introduction to Robotics, 3rd edition 2005, eq. 3.6, with link length a, twist alpha, offset d, angle
    // theta.
    const double a = 0.7, alpha = 0.4, d = -0.3, theta = 1.1;
    const double ct = std::cos(theta), st = std::sin(theta), ca = std::cos(alpha), sa = std::sin(alpha);
    Eigen::Matrix4d craig;
    craig << ct, -st, 0, a,              //
        st * ca, ct * ca, -sa, -sa * d,  //
        st * sa, ct * sa, ca, ca * d,    //
        0, 0, 0, 1;
    DhParameters dh;
    dh.alpha = alpha, dh.d = a, dh.theta0 = theta, dh.r0 = d;
    const Placement pose = dh.placement();
    CHECK(max_abs(pose.R - craig.topLeftCorner<3, 3>()) < 1e-15);
    CHECK(max_abs(pose.p - craig.topRightCorner<3, 1>()) < 1e-15);

    const DhParameters back = dh_parameters(pose);
    CHECK(std::abs(back.gamma) < 1e-15);
    CHECK(std::abs(back.b) < 1e-15);
    CHECK(back.alpha == Approx(alpha).epsilon(1e-14));
    CHECK(back.d == Approx(a).epsilon(1e-14));
    CHECK(back.theta0 == Approx(theta).epsilon(1e-14));
    CHECK(back.r0 == Approx(d).epsilon(1e-14));
}

TEST_CASE("dh: the coordinate adds to theta of a revolute and to r of a prismatic joint, on the base and on a body",
          "[analytic]") {
    Random random(5);
    for (int i = 0; i < 50; ++i) {
        Tree tree;
        const Vector x = random_state(random, 6, 2), y = random_state(random, 6, 2), q = random_state(random, 2, 3);
        const auto add = [&](const char* name, FrameId inboard, JointKind kind, const Vector& v) {
            return tree.add_body(
                BodySpec{.name = name, .inboard = inboard, .joint = kind, .inertia = random_inertia(random)},
                DhParameters{v(0), v(1), v(2), v(3), v(4), v(5)});
        };
        const BodyId turning = add("turning", Tree::base(), JointKind::revolute, x);
        add("sliding", tree.frame_of(turning), JointKind::prismatic, y);
        const Model model(tree);
        Workspace workspace(model);
        const Kinematics kin = kinematics(model, q, workspace);
        const Placement first = product(x(0), x(1), x(2), x(3), x(4) + q(0), x(5));
        const Placement second = first * product(y(0), y(1), y(2), y(3), y(4), y(5) + q(1));
        const Pose<double> at_first = pose(kin, model.frame("turning")), at_second = pose(kin, model.frame("sliding"));
        REQUIRE(max_abs(at_first.R - first.R) < 4e-15);
        REQUIRE(max_abs(at_first.p - first.p) < 1e-14);
        REQUIRE(max_abs(at_second.R - second.R) < 4e-15);
        REQUIRE(max_abs(at_second.p - second.p) < 2e-14);
    }
}

namespace {

constexpr double beam_length = 2.5;
constexpr double joint_station = 0.2113248654;  // cardan joints at this times the length from either end

struct ElementJoint {
    const char* name;
    JointKind kind;
    DhParameters dh;  // from the joint before
    double station;   // along the beam, from the start of the element
    Mat3 axes;        // columns: x, y, z of the joint frame in beam axes
};

// The six joints of a cardanic beam element: bending y, z; extension, torsion; bending z, y. In beam axes (x along the
// beam) the joint frames have z along y, z, x, x, z, y.
std::vector<ElementJoint> element_joints(bool first) {
    const double h = pi / 2, rest = (0.5 - joint_station) * beam_length;
    const auto axes = [](int x, int y, int z) {
        return (Mat3() << Vec3::Unit(x), Vec3::Unit(y), Vec3::Unit(z)).finished();
    };
    const Mat3 along_y = axes(2, 0, 1), along_z = axes(0, 1, 2), along_x = axes(1, 2, 0);
    const DhParameters start = first ? DhParameters{pi, 0, h, -joint_station * beam_length, h, 0}
                                     : DhParameters{h, 0, 0, 2 * joint_station * beam_length, -h, 0};
    return {{"bending y in", JointKind::revolute, start, joint_station * beam_length, along_y},
            {"bending z in", JointKind::revolute, {h, 0, h, 0, 0, 0}, joint_station * beam_length, along_z},
            {"extension", JointKind::prismatic, {h, 0, h, 0, 0, rest}, beam_length / 2, along_x},
            {"torsion", JointKind::revolute, {}, beam_length / 2, along_x},
            {"bending z out", JointKind::revolute, {pi, rest, h, 0, h, 0}, (1 - joint_station) * beam_length, along_z},
            {"bending y out", JointKind::revolute, {pi, 0, h, 0, h, 0}, (1 - joint_station) * beam_length, along_y}};
}

}  // namespace

TEST_CASE("dh: the chain of a beam element by parameters is the same chain by placements", "[analytic]") {
    Random random(6);
    Tree by_parameters, by_placements;
    FrameId parameters_at = Tree::base(), placements_at = Tree::base();
    Placement before;
    std::vector<Placement> expected;
    for (int element = 0; element < 3; ++element)
        for (const ElementJoint& joint : element_joints(element == 0)) {
            BodySpec spec;
            spec.name = text("element ", element, " ", joint.name);
            spec.joint = joint.kind;
            spec.inertia = random_inertia(random);
            const Placement in_base{joint.axes, Vec3((element + joint.station / beam_length) * beam_length, 0, 0)};
            spec.placement = before.inverse() * in_base;
            spec.inboard = placements_at;
            placements_at = by_placements.frame_of(by_placements.add_body(spec));
            spec.inboard = parameters_at;
            parameters_at = by_parameters.frame_of(by_parameters.add_body(spec, joint.dh));
            before = in_base;
            expected.push_back(in_base);
        }
    const Model a(by_parameters), b(by_placements);
    const int n = a.size();
    Workspace work_a(a), work_b(b);
    const Vector zero = Vector::Zero(n);
    const Kinematics straight = kinematics(a, zero, work_a);
    for (int k = 0; k < n; ++k) {
        const Placement& at = entry(expected, k);
        const Pose<double> actual = pose(straight, a.frame(a.body(k).name));
        REQUIRE(max_abs(actual.R - at.R) < 4e-15);
        REQUIRE(max_abs(actual.p - at.p) < 2e-14);
    }

    const Vector q = random_state(random, n, 0.5), qd = random_state(random, n);
    const Kinematics kin_a = kinematics(a, q, work_a), kin_b = kinematics(b, q, work_b);
    Matrix g_a(n, n), g_b(n, n);
    metric(kin_a, g_a);
    metric(kin_b, g_b);
    CHECK(max_abs(g_a - g_b) < 1e-14 * max_abs(g_b));
    Christoffel gamma_a(a), gamma_b(b);
    christoffel_first_kind(kin_a, gamma_a);
    christoffel_first_kind(kin_b, gamma_b);
    double worst = 0, scale = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k) {
                worst = std::max(worst, std::abs(gamma_a(i, j, k) - gamma_b(i, j, k)));
                scale = std::max(scale, std::abs(gamma_b(i, j, k)));
            }
    CHECK(scale > 1);
    CHECK(worst < 1e-14 * scale);
}
