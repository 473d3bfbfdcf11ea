// Gradients of constraints in the metric: projections and multipliers beside the inverse metric, and rank whatever the
// units and masses.
#include "mbs/base/decompositions.hpp"
#include "mbs/loops/constraint_factor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/tree_tools.hpp"

#include <cmath>

using namespace cardan;
using namespace cardan::testing;

TEST_CASE("loops: projection and multipliers of redundant constraints", "[property]") {
    // Random gradients of which some are combinations of others.
    for (unsigned seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        const Model model(random_tree(random, {.bodies = 10}));
        const int n = model.size(), m = 6, r = 4;
        const Matrix few = random_matrix(random, r, n);
        Matrix G(m, n);
        G << few, random_matrix(random, m - r, r) * few;
        Workspace workspace(model);
        const Vector q = random_state(random, n);
        const Kinematics kin = kinematics(model, q, workspace);
        Matrix g(n, n);
        metric(kin, g);
        MetricFactor metric_factor(model);
        REQUIRE(metric_factor.factorise(kin).ok());
        ConstraintFactor factor(model, m);
        factor.factorise(metric_factor, G, G.cwiseAbs(), 1e-9);
        REQUIRE(factor.rank() == r);
        const Matrix inverse = g.inverse(), A = G * inverse * G.transpose();
        const Vector y = A * random_state(random, m);  // one that can be met
        Vector x(n), lambda(m);
        factor.shortest(y, x);
        factor.multipliers(y, lambda);
        CHECK(scaled(G * x - y, y) < 1e-9);
        CHECK(scaled(A * lambda - y, y) < 1e-9);
        CHECK(scaled(inverse * G.transpose() * lambda - x, x) < 1e-9);  // no way is shorter
        // No other multipliers are, each times the length of its gradient: these have nothing in the null space.
        Eigen::FullPivLU<Matrix> lu(A);
        lu.setThreshold(1e-9);
        const Matrix null = lu.kernel();
        CHECK(null.cols() == m - r);
        const Vector measured = A.diagonal().cwiseProduct(lambda);
        CHECK((null.transpose() * measured).norm() < 1e-8 * measured.norm() * null.norm());
    }
}

TEST_CASE("loops: which equations are independent depends on no unit and on no mass", "[property]") {
    // Random gradients, two of six redundant, with equations, coordinates and masses in other units.
    for (unsigned seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        Tree tree;
        FrameId end = Tree::base();
        const int n = 8, m = 6, r = 4;
        // Sliders on one another: the metric is that of their masses.
        for (int i = 0; i < n; ++i)
            end = add_joint(tree, {.name = text("slider ", i),
                                   .inboard = end,
                                   .kind = JointKind::prismatic,
                                   .axis = Vec3::UnitX(),
                                   .inertia = {std::pow(10.0, -3 * (i % 4)), Vec3::Zero(), Mat3::Zero()}})
                      .axes;
        const Model model(tree);
        Workspace workspace(model);
        const Kinematics kin = kinematics(model, Vector::Zero(n), workspace);
        MetricFactor metric_factor(model);
        REQUIRE(metric_factor.factorise(kin).ok());
        const Matrix few = random_matrix(random, r, n);
        Matrix G(m, n);
        G << few, random_matrix(random, m - r, r) * few;
        const auto powers = [&](int count) {
            Vector v(count);
            for (double& x : v) x = std::pow(10.0, std::uniform_int_distribution<>(-9, 9)(random));
            return v;
        };
        ConstraintFactor factor(model, m);
        for (const double tolerance : {1e-4, 1e-9}) {
            factor.factorise(metric_factor, G, G.cwiseAbs(), tolerance);
            CHECK(factor.rank() == r);
            const Matrix scaled_rows = powers(m).asDiagonal() * G;
            factor.factorise(metric_factor, scaled_rows, scaled_rows.cwiseAbs(), tolerance);
            CHECK(factor.rank() == r);
        }
    }
}

TEST_CASE("loops: a gradient all but parallel to another for a light body is independent, one that vanishes is not",
          "[analytic]") {
    // Two sliders, one of them light: (1, 1) and (1, 2) in the inverse metric diag(1, 1/mass).
    for (const double mass : {1e-3, 1e-9, 1e-15, 1e-21}) {
        CAPTURE(mass);
        Tree tree;
        add_joint(tree, {.name = "heavy", .kind = JointKind::prismatic, .inertia = {1, Vec3::Zero(), Mat3::Zero()}});
        add_joint(tree, {.name = "light", .kind = JointKind::prismatic, .inertia = {mass, Vec3::Zero(), Mat3::Zero()}});
        const Model model(tree);
        Workspace workspace(model);
        MetricFactor metric_factor(model);
        REQUIRE(metric_factor.factorise(kinematics(model, Vector::Zero(2), workspace)).ok());
        ConstraintFactor factor(model, 2);
        const Matrix G = (Matrix(2, 2) << 1, 1, 1, 2).finished();
        factor.factorise(metric_factor, G, G.cwiseAbs(), 1e-4);
        REQUIRE(factor.rank() == 2);
        Vector x(2);
        factor.shortest(Vector{{3.0, 4.0}}, x);  // x + y = 3, x + 2 y = 4
        CHECK(x(0) == Approx(2).epsilon(4e-15 / std::sqrt(mass)));
        CHECK(x(1) == Approx(1).epsilon(4e-15 / std::sqrt(mass)));
        // Of terms that cancel, a hundred thousandth is left.
        const Matrix vanishing = (Matrix(2, 2) << 1e-5, 1e-5, 1, 2).finished();
        factor.factorise(metric_factor, vanishing, Matrix::Ones(2, 2), 1e-4);
        CHECK(factor.rank() == 1);
        CHECK(factor.independent()[0] == 1);
        // A gear of so small a ratio has no terms that cancel.
        factor.factorise(metric_factor, vanishing, vanishing.cwiseAbs(), 1e-4);
        CHECK(factor.rank() == 2);
    }
}
