// Eigenvalues of general real matrices and the dense kernels: against Eigen's, by residuals, and without allocations.
#include "mbs/base/decompositions.hpp"
#include "solvers/algebra/dense.hpp"
#include "solvers/algebra/real_eigen.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <limits>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

Matrix seeded_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
    std::srand(seed);
    return Matrix::Random(rows, columns);
}

std::vector<Complex> by_real_part(std::vector<Complex> values) {
    std::sort(values.begin(), values.end(), [](Complex a, Complex b) {
        return std::pair(a.real(), std::abs(a.imag())) < std::pair(b.real(), std::abs(b.imag()));
    });
    return values;
}

// With non-negative imaginary part, once per pair.
std::vector<Complex> upper_half(const Eigen::VectorXcd& values) {
    std::vector<Complex> upper;
    for (const Complex value : values)
        if (value.imag() >= 0) upper.push_back(value);
    return by_real_part(std::move(upper));
}

ComplexVector vector_of(const RealEigen& solver, const RealEigen::Value& value) {
    ComplexVector x = solver.vectors().col(value.column).cast<Complex>();
    if (value.mu.imag() != 0) x += Complex(0, 1) * solver.vectors().col(value.column + 1);
    return x;
}

double largest_residual(const Matrix& A, const RealEigen& solver) {
    double largest = 0;
    for (const RealEigen::Value& value : solver.values()) {
        const ComplexVector x = vector_of(solver, value);
        largest = std::max(largest, (A * x - value.mu * x).norm() / (A.norm() * x.norm()));
    }
    return largest;
}

}  // namespace

TEST_CASE("real eigen: residuals are of the order of rounding, eigenvalues those of Eigen", "[crosscheck]") {
    for (const Eigen::Index n : {1, 2, 3, 4, 5, 6, 9, 33, 34, 35, 36, 64, 67, 101, 150}) {
        RealEigen solver(n, n);
        for (unsigned seed = 0; seed < 5; ++seed) {
            CAPTURE(n, seed);
            const Matrix A = seeded_matrix(n, n, seed);
            REQUIRE(solver.compute(A));
            CHECK(largest_residual(A, solver) < 1e-14);
            std::vector<Complex> own;
            for (const RealEigen::Value& value : solver.values()) own.push_back(value.mu);
            own = by_real_part(std::move(own));
            const std::vector<Complex> other = upper_half(Eigen::EigenSolver<Matrix>(A).eigenvalues());
            REQUIRE(own.size() == other.size());
            for (std::size_t i = 0; i < own.size(); ++i) CHECK(std::abs(own[i] - other[i]) < 1e-11 * A.norm());
        }
    }
}

TEST_CASE("real eigen: the first rows of the vectors are the first rows of the whole vectors", "[property]") {
    const Matrix A = seeded_matrix(60, 60, 3);
    RealEigen whole(60, 60), part(60, 25);
    REQUIRE(whole.compute(A));
    REQUIRE(part.compute(A));
    CHECK(part.vectors() == whole.vectors().topRows(25));
}

TEST_CASE("real eigen: known spectra, among them rotations, permutations, triangles and defective matrices",
          "[analytic]") {
    const auto values = [](const Matrix& A) {
        RealEigen solver(A.rows(), A.rows());
        REQUIRE(solver.compute(A));
        CHECK(largest_residual(A, solver) < 1e-14);
        std::vector<Complex> found;
        for (const RealEigen::Value& value : solver.values()) found.push_back(value.mu);
        return by_real_part(std::move(found));
    };
    const auto largest_error = [](const std::vector<Complex>& found, const std::vector<Complex>& exact) {
        REQUIRE(found.size() == exact.size());
        double error = 0;
        for (std::size_t i = 0; i < exact.size(); ++i) error = std::max(error, std::abs(found[i] - exact[i]));
        return error;
    };
    CHECK(values(Matrix(0, 0)).empty());
    CHECK(largest_error(values((Matrix(2, 2) << 3, -4, 4, 3).finished()), {{3, 4}}) < 1e-14);
    CHECK(largest_error(values(Matrix::Zero(3, 3)), {0, 0, 0}) == 0);
    CHECK(largest_error(values(Matrix::Identity(4, 4)), {1, 1, 1, 1}) == 0);
    // A cyclic permutation turns the plain double shift round in a circle: exceptional shifts have to help.
    const int n = 12;
    Matrix cycle = Matrix::Zero(n, n);
    for (int i = 0; i < n; ++i) cycle((i + 1) % n, i) = 1;
    std::vector<Complex> roots;
    for (int k = 0; k <= n / 2; ++k) roots.push_back(std::polar(1.0, 2 * pi * k / n));
    CHECK(largest_error(values(cycle), by_real_part(roots)) < 1e-13);
    // One eigenvector for a double eigenvalue: an error of the root of rounding is the condition of the problem.
    const Matrix defective = (Matrix(3, 3) << 2, 1, 0, 0, 2, 0, 0, 0, 5).finished();
    CHECK(largest_error(values(defective), {2, 2, 5}) < 1e-7);
}

TEST_CASE("real eigen: what is not finite is refused, and the solver works afterwards", "[property]") {
    RealEigen solver(5, 5);
    const Matrix good = seeded_matrix(5, 5, 1);
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Matrix A = good;
        A(2, 3) = bad;
        CHECK_FALSE(solver.compute(A));
        REQUIRE(solver.compute(good));
        CHECK(largest_residual(good, solver) < 1e-14);
    }
}

TEST_CASE("dense kernels: product, elimination and definiteness agree with Eigen", "[crosscheck]") {
    for (const Eigen::Index n : {1, 2, 7, 47, 48, 49, 130, 300}) {
        CAPTURE(n);
        const Matrix A = seeded_matrix(n, n, 5), B = seeded_matrix(n, n / 2 + 1, 6);
        Matrix C = B;
        add_product(C, A, B, -1);
        CHECK((C - (B - A * B)).norm() < 1e-14 * A.norm() * B.norm());
        Matrix lu = A, x = B;
        solve_in_place(lu, x);
        CHECK((A * x - B).norm() < 1e-13 * A.norm() * x.norm());
        LuFactors factors(n);
        factors.matrix() = A;
        factors.factorise();
        Vector y = B.col(0);
        factors.solve(y);
        CHECK((y - x.col(0)).norm() < 1e-12 * A.norm() * x.norm());
        Matrix S = A * A.transpose() + 1e-3 * Matrix::Identity(n, n);
        const Matrix definite = S;
        CHECK(positive_definite(S));
        S = definite;
        S(n / 2, n / 2) = -1e-3;
        CHECK_FALSE(positive_definite(S));
    }
}

TEST_CASE("real eigen and dense kernels: nothing is allocated, for large matrices neither", "[property]") {
    if (!AllocationGuard::works()) return;
    for (const Eigen::Index n : {6, 60, 150, 420}) {
        CAPTURE(n);
        const Matrix A = seeded_matrix(n, n, 7), B = seeded_matrix(n, 2 * n, 8);
        Matrix C = B, D = A;
        CHECK(allocations([&] { add_product(C, A, B); }) == 0);
        CHECK(allocations([&] { solve_in_place(D, C); }) == 0);
        LuFactors factors(n);
        factors.matrix() = A;
        Vector y = B.col(0);
        CHECK(allocations([&] { factors.factorise(); }) == 0);
        CHECK(allocations([&] { factors.solve(y); }) == 0);
        D = A;
        CHECK(allocations([&] { (void)positive_definite(D); }) == 0);
        if (n > 150) continue;
        RealEigen solver(n, n / 2);
        bool converged = false;
        for (int round = 0; round < 2; ++round) CHECK(allocations([&] { converged = solver.compute(A); }) == 0);
        CHECK(converged);
    }
}

TEST_CASE("real eigen: a double pair without coupling has two independent vectors", "[property]") {
    // The same 2 x 2 block twice, among others, in random axes; vectors that were any mixture would be nearly parallel
    // at times.
    for (unsigned seed = 0; seed < 100; ++seed) {
        const Eigen::Index n = 6 + seed % 15;
        Matrix A = seeded_matrix(n, n, seed).triangularView<Eigen::Upper>();
        A.topLeftCorner(4, 4).setZero();
        for (const Eigen::Index at : {0, 2}) A.block(at, at, 2, 2) << -0.1, 3, -2, 0.3;
        const Matrix Q = orthogonal_factor(seeded_matrix(n, n, seed + 1000));
        RealEigen solver(n, n);
        REQUIRE(solver.compute(Q * A * Q.transpose()));
        CAPTURE(seed, n);
        CHECK(largest_residual(Q * A * Q.transpose(), solver) < 1e-13);
        std::vector<ComplexVector> pair;
        for (const RealEigen::Value& value : solver.values())
            if (std::abs(value.mu - Complex(0.1, std::sqrt(5.96))) < 1e-9)
                pair.push_back(vector_of(solver, value).normalized());
        REQUIRE(pair.size() == 2);
        CHECK(std::abs(pair[0].dot(pair[1])) < 0.99);
    }
}
