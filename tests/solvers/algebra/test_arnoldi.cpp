// The largest eigenvalues of operators: closed forms, multiple and defective eigenvalues, against the dense solver.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/arnoldi.hpp"
#include "solvers/algebra/real_eigen.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

#include <algorithm>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

using Index = Eigen::Index;

DominantEigen dominant_of(const Matrix& A, double min, int most = 200) {
    const LinearOperator apply = [&](const Vector& x, Vector& y) { y = A * x; };
    return dominant_eigenvalues(apply, A.rows(), {.min_magnitude = min, .max_vectors = most});
}

double rest_of_pair(const Matrix& A, const DominantEigen::Value& value) {
    return (A * value.vector - value.mu * value.vector).norm() / std::abs(value.mu);
}

Matrix random_full(Random& random, Index n) {
    return Matrix::NullaryExpr(n, n, [&] { return uniform(random, -1, 1); });
}

// D in other coordinates, in which no entry is zero.
Matrix hidden(Random& random, const Matrix& D) {
    const Index n = D.rows();
    const Matrix T = Matrix::Identity(n, n) + 0.3 / std::sqrt(static_cast<double>(n)) * random_full(random, n);
    return T * D * T.inverse();
}

}  // namespace

TEST_CASE("Arnoldi: multiple eigenvalues come as often as they are there", "[analytic]") {
    Random random(7);
    Vector values(60);
    for (Index i = 0; i < 60; ++i) values(i) = std::pow(0.9, i);
    values.segment(3, 4).setConstant(-values(3));  // four times
    values.segment(10, 2).setConstant(values(10));
    const Matrix A = hidden(random, values.asDiagonal());
    const DominantEigen found = dominant_of(A, 0.2);
    REQUIRE(found.complete);
    const Vector sizes = values.cwiseAbs();
    const auto wanted = (sizes.array() >= 0.2).count();
    const auto above = std::count_if(found.values.begin(), found.values.end(),
                                     [](const auto& value) { return std::abs(value.mu) >= 0.2; });
    CHECK(above == wanted);
    for (Index i = 0; i < wanted; ++i) {
        const DominantEigen::Value& value = found.values.at(static_cast<std::size_t>(i));
        CHECK(std::abs(value.mu) == Approx(sizes(i)).epsilon(1e-10));
        CHECK(rest_of_pair(A, value) < 1e-11);
    }
}

TEST_CASE("Arnoldi: complex pairs, and a multiple eigenvalue with one vector only", "[analytic]") {
    Random random(8);
    // Blocks [a b; -b a]: eigenvalues a +- i b.
    Matrix D = Matrix::Zero(50, 50);
    for (Index i = 0; i < 50; i += 2) {
        const double size = std::pow(0.85, static_cast<double>(i / 2)), angle = static_cast<double>(i);
        D.block(i, i, 2, 2) << size * std::cos(angle), size * std::sin(angle), -size * std::sin(angle),
            size * std::cos(angle);
    }
    const Matrix A = hidden(random, D);
    const DominantEigen found = dominant_of(A, 0.4);
    REQUIRE(found.complete);
    int pairs = 0;
    for (const DominantEigen::Value& value : found.values) {
        CHECK(value.mu.imag() >= 0);
        CHECK(rest_of_pair(A, value) < 1e-11);
        pairs += std::abs(value.mu) >= 0.4 ? 1 : 0;
    }
    CHECK(pairs == 7);  // 0.85^5 = 0.44, and the first block is 1 twice

    // Eigenvalue 2 twice in a Jordan block, as a free displacement has: found twice, to the root of rounding.
    D.setZero();
    for (Index i = 2; i < 50; ++i) D(i, i) = 1.0 / static_cast<double>(i);
    D.topLeftCorner(2, 2) << 2, 1, 0, 2;
    const DominantEigen jordan = dominant_of(hidden(random, D), 0.3);
    REQUIRE(jordan.complete);
    const auto twice = std::count_if(jordan.values.begin(), jordan.values.end(),
                                     [](const auto& value) { return std::abs(value.mu - 2.0) < 1e-5; });
    // A complex pair counts for two.
    CHECK((twice == 2 || (twice == 1 && jordan.values[0].mu.imag() > 0)));
    CHECK(std::abs(jordan.values.back().mu) < 0.55);
}

TEST_CASE("Arnoldi: as the dense solver on random matrices; every one or none", "[crosscheck]") {
    Random random(9);
    for (int trial = 0; trial < 60; ++trial) {
        const Index n = 1 + static_cast<Index>(trial) * 2;
        const Matrix A = random_full(random, n);
        RealEigen dense(n, n);
        REQUIRE(dense.compute(A));
        double largest = 0;
        for (const RealEigen::Value& value : dense.values()) largest = std::max(largest, std::abs(value.mu));
        const double min = 0.7 * largest;
        const DominantEigen found = dominant_of(A, min);
        REQUIRE(found.complete);
        for (const RealEigen::Value& value : dense.values()) {
            if (std::abs(value.mu) < min) continue;
            double nearest = 1;
            for (const DominantEigen::Value& own : found.values)
                nearest = std::min(nearest, std::abs(own.mu - value.mu) / std::abs(value.mu));
            CAPTURE(n, value.mu);
            CHECK(nearest < 1e-9);
        }
    }
    const Matrix A = random_full(random, 80);
    CHECK(!dominant_of(A, 1, 20).complete);
    CHECK(dominant_of(A, 1, 20).values.empty());
    CHECK(dominant_of(Matrix::Zero(5, 5), 1).complete);
    CHECK(dominant_of(Matrix::Zero(5, 5), 1).values.empty());
    CHECK(dominant_of(Matrix::Identity(5, 5), 0.9).values.size() == 5);
    CHECK(dominant_of(Matrix(0, 0), 1).complete);
}

TEST_CASE("Arnoldi: bad input is refused", "[bad input]") {
    const Matrix A = Matrix::Identity(3, 3);
    check_refused([&] { (void)dominant_of(A, 0); }, {"minimum magnitude", "0"});
    check_refused([&] { (void)dominant_of(A, 1, 0); }, {"limit of vectors", "0"});
}
