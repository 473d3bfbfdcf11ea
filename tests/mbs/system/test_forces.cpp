// Every force element: generalised force against its energy, its power, virtual work, and Lagrange's eq. (7).
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "mbs/kernels/lagrange.hpp"
#include "tests/mbs/system/forced_tree.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"

#include <Eigen/Geometry>

using namespace cardan;
using namespace cardan::testing;

namespace {

// Jacobian of a frame by complex step of its pose: columns [rotation vector rate; velocity].
Matrix differentiated_pose(ForcedTree& s, FrameId frame) {
    WorkspaceT<Complex> workspace(s.model());
    const Mat3 R = pose(s.kin(), frame).R;
    Matrix J(6, s.n);
    for (int a = 0; a < s.n; ++a) {
        ComplexVector z = s.q.cast<Complex>();
        z(a) += Complex(0, complex_step);
        const Pose<Complex> moved = pose(kinematics<Complex>(s.model(), z, workspace), frame);
        const Mat3 W = moved.R.imag() / complex_step * R.transpose();
        J.col(a) << W(2, 1), W(0, 2), W(1, 0), moved.p.imag() / complex_step;
    }
    return J;
}

}  // namespace

TEST_CASE("forces: springs, coupled blocks, gravity and dead forces are minus the gradient of their energy",
          "[property]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        for (int kind = 0; kind < 4; ++kind) {
            ForcedTree s(seed, [&](ForcedTree& at, ForceSet& set) {
                if (kind == 0) set.add_spring("spring", BodyId{3}, 4.2, 0, 0.3);
                if (kind == 1) {
                    const Matrix A = Matrix::NullaryExpr(3, 3, [&] { return uniform(at.random, -1, 1); });
                    set.add_law({"block", {BodyId{6}, BodyId{1}, BodyId{4}}, A * A.transpose(), {}, Vec3(1, 2, 3)});
                }
                if (kind == 2) set.set_gravity(random_vector(at.random, 10));
                if (kind == 3) set.add_wrench({"dead force", at.add_tip(), {random_vector(at.random, 5), {0, 0, 0}}});
            });
            const Vector Q = s.Q();
            CAPTURE(seed, kind);
            CHECK(Q.norm() > 0);
            CHECK(scaled(Q - minus_energy_gradient(s), Q) < 1e-10);
            REQUIRE(s.report().size() == 1);
            CHECK(s.report()[0].energy.has_value());
        }
    }
}

TEST_CASE("forces: energies are those written down by hand", "[analytic]") {
    ForcedTree s(3, [](ForcedTree& at, ForceSet& set) {
        set.add_spring("spring", BodyId{2}, 4, 0, 0.5);
        set.add_law({"block", {BodyId{5}, BodyId{0}}, (Matrix(2, 2) << 3, 1, 1, 2).finished()});
        set.add_wrench({"dead force", at.frame(7), {Vec3(1, 2, 3), {0, 0, 0}}});
        set.set_gravity(Vec3(0, 0, -units::standard_gravity));
    });
    const std::vector<ForceReport> report = s.report();
    REQUIRE(report.size() == 4);
    const double x = s.q(s.model().index(BodyId{2})) - 0.5;
    CHECK(report[0].name == "spring");
    CHECK(*report[0].energy == Approx(2 * x * x).epsilon(1e-14));
    const double a = s.q(s.model().index(BodyId{5})), b = s.q(s.model().index(BodyId{0}));
    CHECK(report[1].name == "block");
    CHECK(*report[1].energy == Approx((3 * a * a + 2 * a * b + 2 * b * b) / 2).epsilon(1e-14));
    double height = 0;
    for (int k = 0; k < s.n; ++k) {
        const Model::Body& body = s.model().body(k);
        const Pose<double> at = pose(s.kin(), s.model().frame(body.name));
        height += body.inertia.mass * (at.p + at.R * body.inertia.com)(2);
    }
    CHECK(report[2].name == "gravity");
    CHECK(*report[2].energy == Approx(units::standard_gravity * height).epsilon(1e-13));
    CHECK(report[3].name == "dead force");
    CHECK(*report[3].energy == Approx(-Vec3(1, 2, 3).dot(pose(s.kin(), s.frame(7)).p)).epsilon(1e-13));
}

TEST_CASE("forces: moments and follower loads have no energy, dampers take power", "[property]") {
    ForcedTree s(4, [](ForcedTree& at, ForceSet& set) {
        set.add_wrench({"moment", at.frame(7), {{0, 0, 0}, Vec3(1, 2, 3)}});
        set.add_wrench({"follower", at.frame(6), {Vec3(1, 2, 3), {0, 0, 0}}, WrenchAxes::frame});
        set.add_spring("damper", BodyId{1}, 0, 2.5);
    });
    for (const ForceReport& element : s.report()) {
        CHECK(element.energy.has_value() == (element.name == "damper"));
        if (element.name == "damper") {
            const double rate = s.qd(s.model().index(BodyId{1}));
            CHECK(*element.energy == 0);
            CHECK(element.power == Approx(-2.5 * rate * rate).epsilon(1e-14));
        }
    }
}

TEST_CASE("forces: the powers reported add up to Q . qd, one by one and together", "[property]") {
    for (unsigned seed = 0; seed < 30; ++seed) {
        ForcedTree s(seed, [](ForcedTree& at, ForceSet& set) {
            set = random_forces(at.random, at.tree);
            set.add_element({.name = "drag",
                             .points = {{Tree::base()}},
                             .evaluate = [](const ElementView& in, ElementForces& out) { out.Q -= 0.3 * in.qd; }});
        });
        double power = 0;
        for (const ForceReport& element : s.report()) power += element.power;
        CHECK(power == Approx(s.Q().dot(s.qd)).epsilon(1e-12).margin(1e-12));
        const ForceReport user = s.report().back();
        CHECK(user.name == "drag");
        CHECK(user.power == Approx(-0.3 * s.qd.squaredNorm()).epsilon(1e-13));
        CHECK_FALSE(user.energy.has_value());
    }
}

TEST_CASE("kinematics: the Jacobian of a frame is the derivative of its pose", "[property]") {
    for (unsigned seed = 0; seed < 30; ++seed) {
        ForcedTree s(seed, [](ForcedTree& at, ForceSet&) {
            at.tree.add_frame(at.frame(5), random_placement(at.random), "tip");
        });
        Matrix J(6, s.n);
        for (const char* name : {"tip", "body 7", "base"}) {
            const FrameId frame = s.model().frame(name);
            frame_jacobian<double>(s.kin(), frame, J);
            const Matrix expected = differentiated_pose(s, frame);
            REQUIRE(scaled(J - expected, expected) < 1e-14);
        }
    }
}

TEST_CASE("forces: a wrench on a frame does the virtual work J^T [moment; force], dead or following", "[property]") {
    for (unsigned seed = 0; seed < 30; ++seed)
        for (const WrenchAxes axes : {WrenchAxes::base, WrenchAxes::frame}) {
            FrameLoad load{.name = "load", .axes = axes};
            ForcedTree s(seed, [&](ForcedTree& at, ForceSet& set) {
                load.frame = at.tree.add_frame(at.frame(5), random_placement(at.random), "tip");
                load.wrench = {random_vector(at.random, 3), random_vector(at.random, 3)};
                set.add_wrench(load);
            });
            Vec6 wrench;
            wrench << load.wrench.moment, load.wrench.force;
            const Mat3 R = pose(s.kin(), load.frame).R;
            if (axes == WrenchAxes::frame) wrench << R * load.wrench.moment, R * load.wrench.force;
            const Vector expected = differentiated_pose(s, load.frame).transpose() * wrench;
            REQUIRE(scaled(s.Q() - expected, expected) < 1e-13);
        }
}

TEST_CASE("forces: a wrench on a frame of the base does nothing", "[property]") {
    ForcedTree s(1, [](ForcedTree& at, ForceSet& set) {
        const FrameId ground = at.tree.add_frame(Tree::base(), random_placement(at.random), "ground");
        set.add_wrench({"load", ground, {Vec3(1, 2, 3), Vec3(4, 5, 6)}, WrenchAxes::frame});
    });
    CHECK(s.Q().isZero(0));
}

TEST_CASE("forces: eq. (7) with the weight of every body is the gravity element", "[property]") {
    for (unsigned seed = 0; seed < 30; ++seed) {
        ForcedTree s(seed, [](ForcedTree& at, ForceSet& set) { set.set_gravity(random_vector(at.random, 10)); });
        std::vector<lagrange::BodyLoad> loads(s.n);
        const Vector Q = s.Q();
        const Kinematics kin = s.kin();
        for (int k = 0; k < s.n; ++k) {
            const Mat3 E = kin.rotation(k);
            entry(loads, k).force = s.model().body(k).inertia.mass * (E.transpose() * s.forces().gravity());
        }
        Vector sum(s.n);
        for (int a = 0; a < s.n; ++a) sum(a) = lagrange::generalised_force(kin, loads, a);
        REQUIRE(scaled(Q - sum, Q) < 1e-13);
    }
}

TEST_CASE("forces: eq. (7) with wrenches carried over to the centres of mass is the wrench element", "[property]") {
    for (unsigned seed = 0; seed < 30; ++seed) {
        std::vector<FrameLoad> placed;
        ForcedTree s(seed, [&](ForcedTree& at, ForceSet& set) {
            for (const int body : {7, 3, 3}) {
                const FrameId frame =
                    at.tree.add_frame(at.frame(body), random_placement(at.random), text("frame ", placed.size()));
                placed.push_back({text("load ", placed.size()),
                                  frame,
                                  {random_vector(at.random), random_vector(at.random)},
                                  placed.size() == 1 ? WrenchAxes::base : WrenchAxes::frame});
                set.add_wrench(placed.back());
            }
        });
        std::vector<lagrange::BodyLoad> loads(s.n);
        const Vector Q = s.Q();
        const Kinematics kin = s.kin();
        for (const FrameLoad& load : placed) {
            const int k = s.model().frame(load.frame).body;
            const Pose<double> at = pose(kin, load.frame);
            const Mat3 to_base = load.axes == WrenchAxes::frame ? at.R : Mat3(Mat3::Identity());
            const Vec3 force = to_base * load.wrench.force, moment = to_base * load.wrench.moment;
            const Mat3 to_body = kin.rotation(k).transpose();
            entry(loads, k).force += to_body * force;
            entry(loads, k).moment += to_body * (moment + (at.p - kin.centre_of_mass(k)).cross(force));
        }
        Vector sum(s.n);
        for (int a = 0; a < s.n; ++a) sum(a) = lagrange::generalised_force(kin, loads, a);
        REQUIRE(scaled(Q - sum, Q) < 1e-13);
    }
}

TEST_CASE("forces: rows and columns of a coupled block belong to its coordinates in the order given", "[analytic]") {
    const Mat3 K = (Mat3() << 5, 1, 2, 1, 6, 3, 2, 3, 7).finished();
    const Mat3 D = (Mat3() << 0.5, 0.1, 0, 0.1, 0.6, 0.3, 0, 0.3, 0.7).finished();
    const Vec3 rest(0.1, 0.2, 0.3);
    ForcedTree s(8, [&](ForcedTree&, ForceSet& set) {
        set.add_law({"block", {BodyId{6}, BodyId{0}, BodyId{3}}, K, D, rest});
        set.add_spring("beside", BodyId{0}, 2, 0.25, -0.4);
    });
    const std::vector<int> at{s.model().index(BodyId{6}), s.model().index(BodyId{0}), s.model().index(BodyId{3})};
    Vector expected = Vector::Zero(s.n);
    expected(at) = -K * (s.q(at) - rest) - D * s.qd(at);
    expected(at[1]) -= 2 * (s.q(at[1]) + 0.4) + 0.25 * s.qd(at[1]);
    CHECK((s.Q() - expected).cwiseAbs().maxCoeff() < 1e-14);
    ForceDerivatives d;
    s.forces().derivatives({s, s.kin()}, d);
    Matrix expected_K = Matrix::Zero(s.n, s.n), expected_D = expected_K;
    expected_K(at, at) = K;
    expected_D(at, at) = D;
    expected_K(at[1], at[1]) += 2;
    expected_D(at[1], at[1]) += 0.25;
    CHECK((d.elastic - expected_K).isZero(0));
    CHECK((d.damping - expected_D).isZero(0));
    CHECK(d.gravity.isZero(0));
    CHECK(d.loads.isZero(0));
}

TEST_CASE("forces: dissipation is the power of the damping matrix", "[property]") {
    ForcedTree s(12, [](ForcedTree& at, ForceSet& set) { set = random_forces(at.random, at.tree); });
    ForceDerivatives d;
    s.forces().derivatives({s, s.kin()}, d);
    const double expected = s.qd.dot(d.damping * s.qd);
    CHECK(std::abs(expected) > 0.1);
    CHECK(s.forces().dissipation(s.qd) == Approx(expected).epsilon(1e-13));
}

TEST_CASE("forces: with_gravity() replaces gravity and nothing else", "[property]") {
    ForcedTree s(13, [](ForcedTree& at, ForceSet& set) { set = random_forces(at.random, at.tree); });
    const Vec3 g = s.forces().gravity();
    REQUIRE(s.forces().has_gravity());
    const Forces none = s.forces().with_gravity(Vec3::Zero()), twice = s.forces().with_gravity(2 * g);
    CHECK_FALSE(none.has_gravity());
    CHECK(twice.gravity() == 2 * g);
    const Vector one_part = s.Q() - s.Q(none), two_parts = s.Q(twice) - s.Q(none);
    CHECK(one_part.norm() > 0.1);
    CHECK(scaled(two_parts - 2 * one_part, two_parts) < 1e-13);
    CHECK(s.forces().gravity() == g);
    CHECK(none.report({s, s.kin()}).size() + 1 == s.report().size());
}
