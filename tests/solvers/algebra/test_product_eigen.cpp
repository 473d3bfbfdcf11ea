// Eigenvalues and vectors of products: against the multiplied-out matrix where that is accurate, against factors built
// with known ones where it is not.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "solvers/algebra/product_eigen.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

#include <algorithm>
#include <random>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

using Index = Eigen::Index;

class Numbers {
public:
    explicit Numbers(unsigned seed) : engine_(seed) {}
    double next() { return uniform_(engine_); }
    Matrix matrix(Index n) {
        Matrix A(n, n);
        for (Index j = 0; j < n; ++j)
            for (Index i = 0; i < n; ++i) A(i, j) = next();
        return A;
    }
    Matrix orthogonal(Index n) { return orthogonal_factor(matrix(n)); }

private:
    std::mt19937 engine_;
    std::uniform_real_distribution<double> uniform_{-1, 1};
};

Matrix product_of(const std::vector<Matrix>& factors) {
    Matrix product = factors[0];
    for (std::size_t k = 1; k < factors.size(); ++k) product = factors[k] * product;
    return product;
}

std::vector<Complex> by_magnitude(std::vector<Complex> values) {
    std::sort(values.begin(), values.end(), [](Complex a, Complex b) {
        return std::abs(std::abs(a) - std::abs(b)) > 1e-9 * std::abs(a) ? std::abs(a) > std::abs(b)
                                                                        : a.imag() > b.imag();
    });
    return values;
}

std::vector<Complex> values_of(const ProductEigen& eigen) {
    std::vector<Complex> values;
    for (Index i = 0; i < eigen.size(); ++i) values.push_back(std::exp(eigen.logarithm(i)));
    return by_magnitude(values);
}

std::vector<Complex> values_of(const Matrix& A) {
    const Eigen::VectorXcd mu = Eigen::EigenSolver<Matrix>(A, false).eigenvalues();
    return by_magnitude({mu.begin(), mu.end()});
}

}  // namespace

TEST_CASE("product eigenvalues: those of the multiplied-out matrix for a few random factors", "[property]") {
    Numbers numbers(1);
    for (const int count : {1, 2, 3, 6})
        for (const Index n : {1, 2, 3, 7, 20}) {
            std::vector<Matrix> factors;
            for (int k = 0; k < count; ++k) factors.push_back(Matrix::Identity(n, n) + 0.4 * numbers.matrix(n));
            ProductEigen eigen;
            REQUIRE(eigen.compute(factors));
            const std::vector<Complex> own = values_of(eigen), expected = values_of(product_of(factors));
            for (std::size_t i = 0; i < own.size(); ++i) {
                CAPTURE(count, n, i, own[i], expected[i]);
                CHECK(std::abs(own[i] - expected[i]) < 1e-11 * std::abs(expected[0]));
            }
        }
}

TEST_CASE("product eigenvalues: right and left vectors go round, and belong together", "[property]") {
    Numbers numbers(2);
    for (const int count : {1, 2, 5}) {
        const Index n = 9;
        std::vector<Matrix> factors;
        for (int k = 0; k < count; ++k) factors.push_back(numbers.matrix(n));
        ProductEigen eigen;
        REQUIRE(eigen.compute(factors));
        for (Index i = 0; i < n; ++i) {
            const ProductEigen::Vectors v = eigen.vectors(i);
            Complex mu = 1;
            for (Index k = 0; k < count; ++k) {
                const Matrix& F = entry(factors, k);
                const Index next = (k + 1) % count;
                CAPTURE(count, i, k, v.condition);
                const double size = F.norm() * v.right.col(k).norm();
                CHECK((F * v.right.col(k) - v.growth(k) * v.right.col(next)).norm() < 1e-13 * size);
                const double left = F.norm() * v.left.col(next).norm();
                CHECK((F.transpose() * v.left.col(next) - v.growth(k) * v.left.col(k)).norm() < 1e-13 * left);
                CHECK(std::abs((v.left.col(k).transpose() * v.right.col(k)).value() - 1.0) < 1e-12 * v.condition);
                mu *= v.growth(k);
            }
            CHECK(std::abs(mu / std::exp(eigen.logarithm(i)) - 1.0) < 1e-12);
            CHECK(v.condition >= 1 - 1e-12);
        }
    }
}

TEST_CASE("product eigenvalues: of 1e-90 beside others of 1 to all digits, where the product has lost them",
          "[analytic]") {
    Numbers numbers(3);
    const Index n = 8;
    const int count = 15;
    // F_k = X_k D_k X_{k-1}^-1 with orthogonal X: mu_i is the product of the entries of D.
    Vector level(n);
    level << 1, 0.9, 1e-1, 0.97e-1, 1e-3, 1e-4, 1.1e-4, 1e-6;
    std::vector<Matrix> bases;
    for (int k = 0; k < count; ++k) bases.push_back(numbers.orthogonal(n));
    std::vector<Matrix> factors;
    Vector expected = Vector::Zero(n);
    for (int k = 0; k < count; ++k) {
        Vector d = level;
        for (Index i = 0; i < n; ++i) d(i) *= 1 + 0.2 * numbers.next();
        expected += d.array().log().matrix();
        factors.emplace_back(entry(bases, (k + 1) % count) * d.asDiagonal() * entry(bases, k).transpose());
    }
    std::sort(expected.data(), expected.data() + n, std::greater<>());
    ProductEigen eigen;
    REQUIRE(eigen.compute(factors));
    std::vector<double> own;
    for (Index i = 0; i < n; ++i) {
        own.push_back(eigen.logarithm(i).real());
        CHECK(std::abs(eigen.logarithm(i).imag()) < 1e-9);
    }
    std::sort(own.begin(), own.end(), std::greater<>());
    CHECK(expected(n - 1) < std::log(1e-85));
    for (Index i = 0; i < n; ++i) {
        // Rounding beside the norm of every factor, over its own entry.
        const double tolerance = 1e-14 * count / level(i);
        CAPTURE(i, entry(own, i), expected(i));
        CHECK(std::abs(entry(own, i) - expected(i)) < tolerance);
    }
    const std::vector<Complex> lost = values_of(product_of(factors));
    CHECK(std::log(std::abs(lost.back())) > expected(n - 1) + 50);
}

TEST_CASE("product eigenvalues: complex pairs are found where their product is far below the range of numbers",
          "[analytic]") {
    Numbers numbers(6);
    const Index pairs = 4, n = 2 * pairs;
    const int count = 64;
    // Blocks that turn and shrink: pairs of 1, 1e-128, 1e-256, 1e-384.
    std::vector<Matrix> bases, factors;
    for (int k = 0; k < count; ++k) bases.push_back(numbers.orthogonal(n));
    for (int k = 0; k < count; ++k) {
        Matrix D = Matrix::Zero(n, n);
        for (Index i = 0; i < pairs; ++i) {
            const double level = std::pow(1e-2, i), angle = (1.0 + static_cast<double>(i)) / count;
            D.block<2, 2>(2 * i, 2 * i) << level * std::cos(angle), -level * std::sin(angle), level * std::sin(angle),
                level * std::cos(angle);
        }
        factors.emplace_back(entry(bases, (k + 1) % count) * D * entry(bases, k).transpose());
    }
    ProductEigen eigen;
    REQUIRE(eigen.compute(factors));
    for (Index i = 0; i < pairs; ++i)
        for (const double sign : {-1.0, 1.0}) {
            const Complex expected(count * std::log(std::pow(1e-2, i)),
                                   std::remainder(sign * (1.0 + static_cast<double>(i)), 2 * pi));
            double nearest = infinite;
            for (Index j = 0; j < n; ++j) nearest = std::min(nearest, std::abs(eigen.logarithm(j) - expected));
            // Rounding beside the norm of every factor, over its own entry.
            CAPTURE(i, sign);
            CHECK(nearest < 1e-14 * count / std::pow(1e-2, i));
        }
}

TEST_CASE("product eigenvalues: singular factors leave zeros that are distinguished from the rest", "[property]") {
    Numbers numbers(4);
    for (const Index rank : {1, 4, 9}) {
        const Index n = 10;
        std::vector<Matrix> factors;
        for (int k = 0; k < 4; ++k) factors.push_back(numbers.matrix(n));
        factors[1].bottomRows(n - rank).setZero();
        factors[2].leftCols(2).setZero();
        ProductEigen eigen;
        REQUIRE(eigen.compute(factors));
        std::vector<Complex> own;
        for (Index i = 0; i < n; ++i)
            if (eigen.mean_level(i) > -8) own.push_back(std::exp(eigen.logarithm(i)));
        own = by_magnitude(own);
        const std::vector<Complex> expected = values_of(product_of(factors));
        std::size_t nonzero = 0;
        while (nonzero < expected.size() && std::abs(expected[nonzero]) > 1e-9 * std::abs(expected[0])) ++nonzero;
        CAPTURE(rank, nonzero);
        REQUIRE(own.size() == nonzero);
        for (std::size_t i = 0; i < nonzero; ++i) CHECK(std::abs(own[i] - expected[i]) < 1e-11 * std::abs(expected[0]));
    }
}

TEST_CASE("product eigenvalues: a defective pair has a large condition number, the others none", "[property]") {
    Numbers numbers(5);
    Matrix J = Matrix::Zero(5, 5);
    J.diagonal() << 1, 1, 0.5, -0.8, 0.3;
    J(0, 1) = 1;
    const Matrix Q = numbers.orthogonal(5), G = Matrix::Identity(5, 5) + 0.2 * numbers.matrix(5);
    const std::vector<Matrix> factors = {G, Q * J * Q.transpose() * G.inverse()};
    ProductEigen eigen;
    REQUIRE(eigen.compute(factors));
    int defective = 0;
    for (Index i = 0; i < 5; ++i) {
        const Complex mu = std::exp(eigen.logarithm(i));
        const double condition = eigen.vectors(i).condition;
        if (std::abs(mu - 1.0) < 1e-6) {
            ++defective;
            CHECK(condition > 1e6);
        } else {
            CHECK(condition < 10);
        }
    }
    CHECK(defective == 2);
}

TEST_CASE("product eigenvalues: bad factors are refused", "[property]") {
    ProductEigen eigen;
    check_refused([&] { (void)eigen.compute({}); }, {"number of factors", "0"});
    check_refused(
        [&] {
            (void)eigen.compute({Matrix::Identity(2, 2), Matrix::Identity(3, 3)});
        },
        {"size of a factor", "3 x 3"});
    check_refused([&] { (void)eigen.compute({Matrix::Constant(2, 2, NAN)}); }, {"not finite"});
}
