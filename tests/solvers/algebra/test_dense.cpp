// Dense kernels against Eigen's.
#include "mbs/base/decompositions.hpp"
#include "solvers/algebra/dense.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

TEST_CASE("dense kernels: products of all sizes are Eigen's", "[solvers][property]") {
    Random random(1);
    for (const Eigen::Index m : {0, 1, 3, 11, 12, 13, 25, 100})
        for (const Eigen::Index n : {0, 1, 2, 4, 7, 61})
            for (const Eigen::Index depth : {0, 1, 5, 48, 49, 130}) {
                const Matrix A = random_matrix(random, m, depth), B = random_matrix(random, depth, n),
                             before = random_matrix(random, m, n);
                Matrix whole = random_matrix(random, m + 2, n + 1);
                auto C = whole.block(1, 1, m, n);
                C = before;
                const Matrix frame = whole;
                add_product(C, A, B, -2);
                CAPTURE(m, n, depth);
                const double size = A.norm() * B.norm() + before.norm();
                CHECK((Matrix(C) - (before - 2 * A * B)).norm() <= 1e-15 * size);
                whole.block(1, 1, m, n) = before;
                CHECK(whole == frame);  // nothing beside it
            }
}

TEST_CASE("dense kernels: solutions of all sizes have the residual of Eigen's", "[solvers][property]") {
    Random random(2);
    for (const Eigen::Index n : {1, 2, 7, 8, 9, 16, 47, 48, 49, 96, 131}) {
        const Matrix A = random_matrix(random, n, n), B = random_matrix(random, n, 5);
        const Vector b = B.col(0);
        LuFactors factors(n);
        factors.matrix() = A;
        factors.factorise();
        Matrix X = B, Y = B, destroyed = A;
        Vector x = b;
        factors.solve(X);
        factors.solve(x);
        solve_in_place(destroyed, Y);
        const auto residual = [&](const Matrix& solution) {
            return (A * solution - B).norm() / (A.norm() * solution.norm());
        };
        const double eigen = residual(A.partialPivLu().solve(B));
        CAPTURE(n, eigen);
        CHECK(residual(X) < 3 * eigen + 1e-16);
        CHECK(residual(Y) < 3 * eigen + 1e-16);
        CHECK((A * x - b).norm() < 1e-15 * static_cast<double>(n) * A.norm() * x.norm());
    }
}

TEST_CASE("dense kernels: the transposed equations are solved with the same factors", "[property]") {
    for (const Eigen::Index n : {1, 7, 60, 190}) {
        Matrix A = Matrix::Random(n, n);
        A(0, 0) = 0.1;
        LuFactors factors(n);
        factors.matrix() = A;
        factors.factorise();
        const Matrix b = Matrix::Random(n, 2);
        Matrix x = b;
        factors.solve_transposed(x);
        Vector y = b.col(0);
        factors.solve_transposed(y);
        CHECK((A.transpose() * x - b).norm() < 1e-10);
        CHECK((x.col(0) - y).norm() == 0);
        CHECK(factors.pivot_ratio() > 0);
        CHECK(factors.pivot_ratio() <= 1);
    }
    LuFactors singular(2);
    singular.matrix() << 1, 2, 2, 4;
    singular.factorise();
    CHECK(singular.pivot_ratio() < 1e-15);
}
