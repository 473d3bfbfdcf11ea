// Factors on the branches of the tree against the full matrix.
#include "mbs/kernels/branch_lu.hpp"
#include "mbs/kernels/derivatives.hpp"
#include "mbs/kernels/metric.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

// Of any size that is a multiple of four and any that is not, with branches.
Model random_model(Random& random, unsigned seed) {
    return Model(random_tree(random, {.bodies = 1 + static_cast<int>(seed % 23), .armatures = true}));
}

Matrix full(const BranchMatrix& A) {
    Matrix out(A.size(), A.size());
    A.write(out);
    return out;
}

}  // namespace

TEST_CASE("branch factors: the solution of the tangents of random trees has no residual", "[property]") {
    for (unsigned seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const Model model = random_model(random, seed);
        const int n = model.size();
        const Vector q = random_state(random, n), qd = random_state(random, n), qdd = random_state(random, n);
        Workspace workspace(model);
        const Kinematics kin = kinematics(model, q, workspace);
        BranchMatrix g(model), S(model), C(model);
        metric(kin, g);
        inverse_dynamics_derivatives(kin, qd, qdd, S, C);
        BranchLu factors(model);
        factors.matrix().set_sum(1, g, 1e-2, C, 1e-4, S);
        const Matrix A = full(factors.matrix());
        CAPTURE(seed, n);
        REQUIRE((A - (full(g) + 1e-2 * full(C) + 1e-4 * full(S))).norm() <= 1e-15 * A.norm());
        REQUIRE(factors.factorise());
        const Vector b = random_state(random, n);
        Vector x = b;
        factors.solve(x);
        CHECK((A * x - b).norm() < 1e-13 * (b.norm() + A.norm() * x.norm()));
    }
}

TEST_CASE("branch factors: a pivot that vanishes is refused, not divided by", "[property]") {
    Random random(3);
    const Model model(random_tree(random, {.bodies = 5}));
    BranchLu factors(model);
    for (int a = 0; a < 5; ++a) factors.matrix().add(a, a, a == 2 ? 0.0 : 1.0);
    CHECK_FALSE(factors.factorise());
    factors.matrix().set_sum(0, factors.matrix(), 0, factors.matrix(), 0, factors.matrix());
    for (int a = 0; a < 5; ++a) factors.matrix().set_unit(a);
    CHECK(factors.factorise());
}

TEST_CASE("branch matrix: a full matrix is added where there are branches, and the rest is told", "[property]") {
    for (unsigned seed = 0; seed < 40; ++seed) {
        Random random(seed);
        const Model model = random_model(random, seed);
        const int n = model.size();
        Workspace workspace(model);
        BranchMatrix A(model);
        metric(kinematics(model, random_state(random, n), workspace), A);
        const Matrix g = full(A);
        CAPTURE(seed, n);
        REQUIRE(A.add(g));
        CHECK(full(A) == 2 * g);
        const Matrix other = Matrix::Ones(n, n);
        bool all = true;
        for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b)
                if (!model.precedes(a, b) && !model.precedes(b, a)) all = false;
        CHECK(A.add(other) == all);
        const int m = n / 2;
        A.set_unit(m);
        const Matrix unit = full(A);
        CHECK(unit.row(m) == Matrix::Identity(n, n).row(m));
        CHECK(unit.col(m) == Matrix::Identity(n, n).col(m));
        for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b)
                if (a != m && b != m && (model.precedes(a, b) || model.precedes(b, a)))
                    REQUIRE(unit(a, b) == 2 * g(a, b) + 1);
    }
}
