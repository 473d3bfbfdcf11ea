// Equations of one harmonic, states eliminated by groups: residuals in complex numbers.
#include "solvers/periodic/detail/harmonic_factors.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"

namespace cardan::testing::harmonic_factor_tests {

namespace {

using namespace solvers;
using Index = Eigen::Index;

// Of states that couple in the groups 0, 3, 5 | 1 | 2, 4, 6, 7 behind n coordinates.
const std::vector<std::vector<Index>> groups_of_states{{0, 3, 5}, {1}, {2, 4, 6, 7}};
constexpr Index states = 8;

Matrix random_equations(Random& random, Index n) {
    Matrix A = Matrix::Zero(n + states, n + states);
    A.topRows(n) = random_matrix(random, n, n + states);
    A.bottomLeftCorner(states, n) = random_matrix(random, states, n);
    A.topLeftCorner(n, n).diagonal().array() += 4;
    for (const std::vector<Index>& group : groups_of_states)
        for (const Index i : group) {
            for (const Index j : group) A(n + i, n + j) = uniform(random, -1, 1);
            A(n + i, n + i) += 3;
        }
    return A;
}

std::vector<std::vector<Index>> behind(Index n) {
    std::vector<std::vector<Index>> all = groups_of_states;
    for (std::vector<Index>& group : all)
        for (Index& i : group) i += n;
    return all;
}

// Of (A + i B)(c - i s) = r, a column for c and one for s.
double rest(const Matrix& A, const Matrix& B, const Matrix& z, const Matrix& r) {
    if (B.size() == 0) return (A * z - r).norm();
    return (A * z.col(0) + B * z.col(1) - r.col(0)).norm() + (A * z.col(1) - B * z.col(0) - r.col(1)).norm();
}

}  // namespace

TEST_CASE("factors of a harmonic: solutions satisfy the equations, with states, without, and alone", "[property]") {
    Random random(6);
    for (const Index n : {0, 1, 5}) {
        const Matrix A = random_equations(random, n);
        Matrix B = random_equations(random, n);
        CHECK(coupled_groups(A, n) == behind(n));
        for (const bool forces_at_once : {true, false}) {
            if (!forces_at_once) B.topRightCorner(n, states).setZero();
            for (const Matrix& imaginary : {B, Matrix()}) {
                const HarmonicFactors factors(A, imaginary, behind(n));
                CHECK(factors.rcond() > 1e-4);
                const Matrix r = random_matrix(random, n + states, imaginary.size() > 0 ? 2 : 1);
                Matrix z = r;
                factors.solve(z);
                CAPTURE(n, forces_at_once, imaginary.size());
                CHECK(rest(A, imaginary, z, r) < 1e-12);
            }
        }
        if (n == 0) continue;
        const Matrix A_qq = A.topLeftCorner(n, n), B_qq = B.topLeftCorner(n, n), r = random_matrix(random, n, 2);
        Matrix z = r;
        HarmonicFactors(A_qq, B_qq, {}).solve(z);
        CHECK(rest(A_qq, B_qq, z, r) < 1e-12);
    }
}

TEST_CASE("factors of a harmonic: singular equations are known", "[property]") {
    Random random(2);
    Matrix A = random_equations(random, 3);
    A.row(3 + 1).tail(states).setZero();
    CHECK(coupled_groups(A, 3) == behind(3));
    CHECK(HarmonicFactors(A, {}, behind(3)).rcond() == 0);
    A = random_equations(random, 3);
    A.row(1) = A.row(0);
    CHECK_FALSE(HarmonicFactors(A, {}, behind(3)).rcond() > 1e-12);  // not a number after a pivot of zero
}

}  // namespace cardan::testing::harmonic_factor_tests
