// Curvature of spaces whose geometry is known in closed form.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "mbs/geometry/curvature.hpp"
#include "tests/mbs/sampled_tree.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/point_masses.hpp"
#include "tests/support/tree_tools.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

// One configuration of a tree with its geometry.
struct Space {
    Space(const Tree& tree, const Vector& at) : model(tree), workspace(model), q(at), curvature(model) {
        REQUIRE(curvature.update(kinematics(model, q, workspace)).ok());
    }
    double sectional(const Vector& x, const Vector& y) { return curvature.sectional(x, y); }
    // For a space with two coordinates, which has one plane only.
    double gaussian() { return sectional(Vector::Unit(2, 0), Vector::Unit(2, 1)); }
    double component(int a, int b, int c, int d) {
        const auto e = [&](int i) { return Vector(Vector::Unit(q.size(), i)); };
        return curvature.riemann(e(a), e(b), e(c), e(d));
    }
    double largest_component() {
        double largest = 0;
        const int n = model.size();
        for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b)
                for (int c = 0; c < n; ++c)
                    for (int d = 0; d < n; ++d) largest = std::max(largest, std::abs(component(a, b, c, d)));
        return largest;
    }

    Model model;
    Workspace workspace;
    Vector q;
    Curvature curvature;
};

// Arm of length R about z, then an arm of length r about y that carries the mass: a point on a torus.
Tree torus(double m, double R, double r) {
    Tree tree;
    const Link first = add_joint(tree, {.name = "meridian", .inboard = Tree::base(), .axis = Vec3::UnitZ()});
    const FrameId elbow = tree.add_frame(first.axes, Placement::translation(Vec3(R, 0, 0)), "elbow");
    add_joint(tree,
              {.name = "latitude", .inboard = elbow, .axis = Vec3::UnitY(), .inertia = point_mass(m, Vec3(r, 0, 0))});
    return tree;
}

struct PendulumData {
    double m1, l1, c1, J1, m2, c2, J2;
};

// Two bodies in a plane; c are the distances of the centres of mass, J about them.
Tree double_pendulum(const PendulumData& p) {
    const auto body = [](double m, double c, double J) {
        RigidInertia inertia = point_mass(m, Vec3(c, 0, 0));
        inertia.J.diagonal() << 0, J, J;
        return inertia;
    };
    Tree tree;
    const Link first = add_joint(
        tree, {.name = "first", .inboard = Tree::base(), .axis = Vec3::UnitZ(), .inertia = body(p.m1, p.c1, p.J1)});
    const FrameId elbow = tree.add_frame(first.axes, Placement::translation(Vec3(p.l1, 0, 0)), "elbow");
    add_joint(tree, {.name = "second", .inboard = elbow, .axis = Vec3::UnitZ(), .inertia = body(p.m2, p.c2, p.J2)});
    return tree;
}

// A body that turns about its centre of mass on three joints.
Tree gimballed(const Vec3& moments) {
    Tree tree;
    const Link z = add_joint(tree, {.name = "z", .inboard = Tree::base(), .axis = Vec3::UnitZ()});
    const Link y = add_joint(tree, {.name = "y", .inboard = z.axes, .axis = Vec3::UnitY()});
    add_joint(tree, {.name = "x",
                     .inboard = y.axes,
                     .axis = Vec3::UnitX(),
                     .inertia = {.mass = 1, .com = Vec3::Zero(), .J = moments.asDiagonal()}});
    return tree;
}

// Rates that turn the last body about the axes of its frame `name` with unit speed, as columns.
Matrix rates_about_axes(const Space& space, const Kinematics& kin, std::string_view name) {
    const FrameId frame = space.model.frame(name);
    Matrix J(6, 3);
    frame_jacobian<double>(kin, frame, J);
    return J.topRows(3).inverse() * pose(kin, frame).R;
}

}  // namespace

// A space of translations is Euclidean, the plane and space in polar coordinates as well.
TEST_CASE("curvature: none in trees of prismatic joints and for point masses in polar coordinates", "[analytic]") {
    Random random(1);
    const Tree prismatic = random_tree(random, {.bodies = 6, .prismatic = 1, .massless = 0, .armatures = true});
    CHECK(Space(prismatic, random_state(random, 6)).largest_component() == 0);

    // The radius is 1 + q: the metric must not be singular at q = 0.
    Tree plane;
    const Link turn = add_joint(plane, {.name = "angle", .inboard = Tree::base(), .axis = Vec3::UnitZ()});
    add_joint(plane, {.name = "radius",
                      .inboard = turn.axes,
                      .kind = JointKind::prismatic,
                      .axis = Vec3::UnitX(),
                      .inertia = point_mass(2, Vec3::UnitX())});
    // The second fundamental form is nothing but rounding, the curvature its square.
    CHECK(Space(plane, Eigen::Vector2d(0, 0.5)).largest_component() < 1e-30);
    CHECK(Space(plane, Eigen::Vector2d(0.7, 1.3)).largest_component() < 1e-30);

    Tree sphere = torus(0, 0, 0);
    add_joint(sphere, {.name = "radius",
                       .inboard = sphere.frame("latitude axes"),
                       .kind = JointKind::prismatic,
                       .axis = Vec3::UnitX(),
                       .inertia = point_mass(2, Vec3::UnitX())});
    CHECK(Space(sphere, Vec3(0.7, -0.4, 1.3)).largest_component() < 1e-29);
}

// A generator behind a gear adds one flat dimension: the metric stays constant.
TEST_CASE("curvature: none for two wheels on one shaft with a geared armature", "[analytic]") {
    Tree tree;
    const RigidInertia wheel{.mass = 1, .com = Vec3::Zero(), .J = Vec3(1, 1, 2).asDiagonal()};
    const Link hub = add_joint(tree, {.name = "hub", .inboard = Tree::base(), .inertia = wheel});
    const Link twist = add_joint(tree, {.name = "twist", .inboard = hub.axes, .inertia = wheel});
    tree.add_armature({"generator", 3, {{hub.body, 1}, {twist.body, 1}}});
    CHECK(Space(tree, Eigen::Vector2d(0.3, 1.1)).largest_component() < 1e-30);
}

// The metric m l^2 (cos^2(b) da^2 + db^2) is that of a sphere of radius sqrt(m) l.
TEST_CASE("curvature: a point mass on two crossing joints moves on a sphere, K = 1 / (m l^2)", "[analytic]") {
    for (const double m : {1.0, 2.5})
        for (const double l : {1.0, 0.3}) {
            Space space(torus(m, 0, l), Eigen::Vector2d(0.4, 0.9));
            CHECK(space.gaussian() == Approx(1 / (m * l * l)).epsilon(1e-13));
            // R_abcd = K (g_ac g_bd - g_ad g_bc)
            const double area = std::pow(m * l * l * std::cos(0.9), 2);
            CHECK(space.component(0, 1, 0, 1) == Approx(area / (m * l * l)).epsilon(1e-13));
            CHECK(space.component(0, 1, 1, 0) == Approx(-area / (m * l * l)).epsilon(1e-13));
        }
}

// K = cos(b) / (r (R + r cos b)) on a torus of revolution (do Carmo 1976, section 3-3), divided by m.
TEST_CASE("curvature: a point mass on two joints with an offset moves on a torus, positive outside, negative inside",
          "[analytic]") {
    const double m = 1.7, R = 2, r = 0.6;
    for (const double b : {0.0, 0.8, pi / 2, 2.5, 3.1}) {
        CAPTURE(b);
        CHECK(Space(torus(m, R, r), Eigen::Vector2d(0.4, b)).gaussian() ==
              Approx(std::cos(b) / (m * r * (R + r * std::cos(b)))).epsilon(1e-12).margin(1e-15));
    }
}

// ds^2 = (I + m r^2) da^2 + m dr^2 is a surface of revolution of radius rho(s) = sqrt(I + s^2), s = sqrt(m) r, with
// K = -rho'' / rho = -I / (I + m r^2)^2.
TEST_CASE("curvature: a mass sliding on a turntable has K = -I / (I + m r^2)^2", "[analytic]") {
    const double I = 0.8, m = 1.7;
    Tree tree;
    const Link table = add_joint(tree, {.name = "table",
                                        .inboard = Tree::base(),
                                        .inertia = {.mass = 1, .com = Vec3::Zero(), .J = Vec3(I, I, I).asDiagonal()}});
    add_joint(tree, {.name = "slider",
                     .inboard = table.axes,
                     .kind = JointKind::prismatic,
                     .axis = Vec3::UnitX(),
                     .inertia = point_mass(m, Vec3::Zero())});
    for (const double r : {0.0, 0.5, 2.0})
        CHECK(Space(tree, Eigen::Vector2d(0.4, r)).gaussian() ==
              Approx(-I / std::pow(I + m * r * r, 2)).epsilon(1e-13));
}

// In absolute angles ds^2 = A da^2 + 2 B cos(f) da db + D db^2, f = b - a the relative angle. Turning the whole is an
// isometry whose orbits have the squared radius w = A + D + 2 B cos f, and det g = AD - B^2 cos^2 f, so that
//   K = -(1 / (2 sqrt(det))) d/df (w' / sqrt(det)) = B cos f (AD - B^2) / (AD - B^2 cos^2 f)^2,
// for point masses m1 cos f / (l1 l2 (m1 + m2 sin^2 f)^2).
TEST_CASE("curvature: the double pendulum has K = B cos f (AD - B^2) / (AD - B^2 cos^2 f)^2", "[analytic]") {
    for (const double f : {0.0, 0.7, pi / 2, 2.4, -3.0}) {
        CAPTURE(f);
        const double m1 = 1.3, m2 = 0.7, l1 = 0.9, l2 = 1.4;
        const double points = m1 * std::cos(f) / (l1 * l2 * std::pow(m1 + m2 * std::pow(std::sin(f), 2), 2));
        CHECK(Space(double_pendulum({m1, l1, l1, 0, m2, l2, 0}), Eigen::Vector2d(0.4, f)).gaussian() ==
              Approx(points).epsilon(1e-12).margin(1e-15));

        const PendulumData p{1.3, 0.9, 0.5, 0.2, 0.7, 0.8, 0.3};
        const double A = p.J1 + p.m1 * p.c1 * p.c1 + p.m2 * p.l1 * p.l1, B = p.m2 * p.l1 * p.c2,
                     D = p.J2 + p.m2 * p.c2 * p.c2, c = std::cos(f);
        const double bodies = B * c * (A * D - B * B) / std::pow(A * D - B * B * c * c, 2);
        CHECK(Space(double_pendulum(p), Eigen::Vector2d(0.4, f)).gaussian() ==
              Approx(bodies).epsilon(1e-12).margin(1e-15));
    }
}

// Left-invariant metrics of the rotation group: with e_i = axis i / sqrt(I_i) orthonormal, [e_1, e_2] = lambda_3 e_3
// and cyclic, lambda_i = I_i / sqrt(I_1 I_2 I_3), mu_i = (lambda_1 + lambda_2 + lambda_3) / 2 - lambda_i,
//   K(e_1, e_2) = lambda_3 mu_3 - mu_1 mu_2                                    [Milnor 1976, section 4]
TEST_CASE("curvature: the rotation group of a rigid body, 1 / (4 I) in every plane if it is spherical", "[analytic]") {
    const Vector q = Vec3(0.3, 0.7, -1.1);
    Random random(3);
    Space ball(gimballed(Vec3(2.5, 2.5, 2.5)), q);
    for (int i = 0; i < 5; ++i)
        CHECK(ball.sectional(random_state(random, 3), random_state(random, 3)) == Approx(1 / (4 * 2.5)).epsilon(1e-12));

    for (const Vec3& I : {Vec3(1, 1.5, 2), Vec3(1, 1, 0.1), Vec3(2, 3, 4.9)}) {
        Space body(gimballed(I), q);
        Workspace workspace(body.model);
        const Matrix axes = rates_about_axes(body, kinematics(body.model, q, workspace), "x axes");
        const Vec3 lambda = I / std::sqrt(I.prod()), mu = Vec3::Constant(lambda.sum() / 2) - lambda;
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            CAPTURE(i, I);
            CHECK(body.sectional(axes.col(i), axes.col(j)) ==
                  Approx(lambda(k) * mu(k) - mu(i) * mu(j)).epsilon(1e-11).margin(1e-13));
        }
    }
}

// The space of a free body is the product of Euclidean space and the rotation group.
TEST_CASE("curvature: a free body is flat in every plane that holds a translation of its centre of mass",
          "[analytic]") {
    Tree tree;
    const FrameId body = add_floating_base(tree);
    tree.weld(body, {.mass = 3, .com = Vec3::Zero(), .J = Vec3(2.5, 2.5, 2.5).asDiagonal()}, "ball");
    Random random(4);
    Space space(tree, random_state(random, 6));
    for (int i = 0; i < 3; ++i) {
        CHECK(std::abs(space.sectional(Vector::Unit(6, i), random_state(random, 6))) < 1e-15);
        CHECK(space.sectional(Vector::Unit(6, 3 + i), Vector::Unit(6, 3 + (i + 1) % 3)) == Approx(0.1).epsilon(1e-12));
    }
}
