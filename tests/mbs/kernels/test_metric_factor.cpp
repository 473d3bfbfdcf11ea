// The factor of the metric on the branches. Oracle: Eigen's dense Cholesky factorisation, which knows no tree.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/metric_factor.hpp"
#include "tests/mbs/sampled_tree.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/tree_tools.hpp"

#include <limits>

using namespace cardan;
using namespace cardan::testing;

namespace {

Matrix dense_L(const MetricFactor& factor) {
    const int n = factor.model().size();
    return Matrix::NullaryExpr(
        n, n, [&](Eigen::Index a, Eigen::Index b) { return factor(static_cast<int>(a), static_cast<int>(b)); });
}

// g with the identity in place of what belongs to driven coordinates.
Matrix free_block(Matrix g, const std::vector<bool>& driven) {
    for (const int d : indices_of(driven, true)) {
        g.row(d).setZero();
        g.col(d).setZero();
        g(d, d) = 1;
    }
    return g;
}

struct Factored : SampledTree {
    explicit Factored(unsigned seed)
        : SampledTree(seed, {.bodies = 6 + static_cast<int>(seed % 20), .armatures = seed % 2 == 0}),
          driven(some_driven(seed % 3 == 0 ? 0.4 : 0.0)),
          factor(model, driven),
          block(free_block(g(), driven)) {
        REQUIRE(factor.factorise(kin).ok());
        L = dense_L(factor);
        for (const int d : indices_of(driven, true)) L(d, d) = 1;
    }
    std::vector<bool> driven;
    MetricFactor factor;
    Matrix block, L;
};

Model chain_of_three() {
    Tree tree;
    FrameId inboard = Tree::base();
    for (const char* name : {"tower", "nacelle", "rotor"}) {
        const BodyId body = tree.add_body(
            {.name = name, .inboard = inboard, .inertia = {.mass = 1, .com = Vec3(1, 0, 0), .J = Mat3::Identity()}});
        inboard = tree.frame_of(body);
    }
    return Model(tree);
}

}  // namespace

TEST_CASE("metric factor: L^T L = g with armatures, L lives on the branches and has the rows of the free coordinates",
          "[property]") {
    for (unsigned seed = 0; seed < 200; ++seed) {
        Factored s(seed);
        REQUIRE(largest(s.L.transpose() * s.L - s.block) < 1e-13 * largest(s.block));
        std::size_t stored = 0;
        for (int a = 0; a < s.n; ++a)
            for (int b = 0; b < s.n; ++b) {
                const bool kept = s.model.precedes(b, a) && !s.factor.is_driven(a) && !s.factor.is_driven(b);
                stored += kept ? 1 : 0;
                if (!kept) REQUIRE(s.factor(a, b) == 0);
                if (a == b && kept) REQUIRE(s.factor(a, b) > 0);
            }
        REQUIRE(s.factor.stored() == stored);
    }
}

TEST_CASE("metric factor: solutions, products with L and L^T and their inverses, log det agree with dense algebra",
          "[property]") {
    for (unsigned seed = 0; seed < 200; ++seed) {
        Factored s(seed);
        // More columns than fit into one block, and a few that remain.
        const Matrix x = Matrix::NullaryExpr(s.n, 19, [&] { return uniform(s.random, -1, 1); });
        const auto with = [&](void (MetricFactor::*apply)(MatrixOut), Matrix y) {
            (s.factor.*apply)(y);
            return y;
        };
        // Backward errors: the metric of random trees may be ill-conditioned.
        const double g_size = largest(s.block), L_size = largest(s.L);
        const Matrix solved = with(&MetricFactor::solve, x);
        CHECK(largest(s.block * solved - x) < 1e-12 * g_size * (1 + largest(solved)));
        CHECK(largest(with(&MetricFactor::multiply_L, x) - s.L * x) < 1e-13 * L_size);
        CHECK(largest(with(&MetricFactor::multiply_LT, x) - s.L.transpose() * x) < 1e-13 * L_size);
        const Matrix half = with(&MetricFactor::solve_L, x), other = with(&MetricFactor::solve_LT, x);
        CHECK(largest(s.L * half - x) < 1e-13 * L_size * (1 + largest(half)));
        CHECK(largest(s.L.transpose() * other - x) < 1e-13 * L_size * (1 + largest(other)));
        for (const int d : indices_of(s.driven, true)) CHECK((solved.row(d) - x.row(d)).isZero(0));

        Vector one = x.col(0);
        s.factor.solve(one);
        CHECK(largest(one - solved.col(0)) < 1e-14 * (1 + largest(one)) * s.n);
        const Vector pivots = Eigen::LDLT<Matrix>(s.block).vectorD();
        CHECK(s.factor.log_determinant() == Approx(pivots.array().log().sum()).epsilon(1e-10).margin(1e-8));
    }
}

// Oracle: kinetic energy by the recursion over bodies.
TEST_CASE("metric factor: L qd are rates in an orthonormal frame, half their square is the kinetic energy",
          "[property]") {
    for (unsigned seed = 0; seed < 50; ++seed) {
        SampledTree s(seed, {.armatures = true});
        MetricFactor factor(s.model);
        REQUIRE(factor.factorise(s.kin).ok());
        Vector rates = s.qd;
        factor.multiply_L(rates);
        CHECK(rates.squaredNorm() / 2 == Approx(kinetic_energy(s.kin, s.qd)).epsilon(1e-12));
    }
}

TEST_CASE("metric factor: the default leaves out the coordinates whose role is driven", "[property]") {
    SampledTree s(3, {.driven = 2});
    MetricFactor factor(s.model);
    CHECK(factor.driven() == s.model.coordinates().driven());
    CHECK(indices_of(factor.driven(), true).size() == 2);
}

TEST_CASE("metric factor: a pivot that is not positive is reported with the name of its coordinate", "[property]") {
    const Model model = chain_of_three();
    MetricFactor factor(model);
    Matrix g = Matrix::Identity(3, 3);
    CHECK(factor.factorise(g).ok());
    CHECK(factor.factorise(g).message().empty());

    // Elimination starts at the tip, so the pivot of "nacelle" is 1 - 2 * 2 / 2.
    g << 3, 0, 0, 0, 1, 2, 0, 2, 2;
    const PivotStatus indefinite = factor.factorise(g);
    CHECK_FALSE(indefinite.ok());
    CHECK(indefinite.index == 1);
    CHECK(indefinite.coordinate == "nacelle");
    CHECK(indefinite.pivot == Approx(-1));
    CHECK(indefinite.diagonal == 1);
    for (const char* part : {"'nacelle'", "pivot -1", "not positive definite", "add an armature"})
        CHECK(indefinite.message().find(part) != std::string::npos);

    g.setIdentity();
    g(2, 2) = std::numeric_limits<double>::quiet_NaN();
    CHECK(factor.factorise(g).coordinate == "rotor");
    // Singular but for rounding of either sign: (p, r)^T (p, r).
    for (int i = 1; i < 20; ++i) {
        const double p = 0.1 * i / 1.7, r = 0.3;
        g << 1, 0, 0, 0, p * p, p * r, 0, p * r, r * r;
        CHECK(factor.factorise(g).coordinate == "nacelle");
    }
    // A driven coordinate needs no pivot.
    MetricFactor without(model, {false, true, false});
    CHECK(without.factorise(g).ok());
}

TEST_CASE("metric factor: a wrong number of driven flags is refused", "[property]") {
    const Model model = chain_of_three();
    check_refused([&] { MetricFactor(model, {true}); }, {"metric factor", "driven flags", "= 1", "3"});
}
