// Matrices in groups of rows that couple: against dense ones.
#include "mbs/base/error.hpp"
#include "solvers/algebra/grouped_matrix.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"

namespace cardan::testing::grouped_matrix_tests {

namespace {

using namespace solvers;
using Index = Eigen::Index;
using Groups = std::vector<std::vector<Index>>;

const Groups three{{0, 3, 5}, {1}, {2, 4, 6, 7}};

Matrix grouped(Random& random, const Groups& groups) {
    Matrix A = Matrix::Zero(8, 8);
    for (const std::vector<Index>& rows : groups)
        for (const Index i : rows) {
            for (const Index j : rows) A(i, j) = uniform(random, 0.1, 1);
            A(i, i) += 3;
        }
    return A;
}

Groups rows_of(const GroupedMatrix& A) {
    Groups rows;
    for (const GroupedMatrix::Group& group : A.groups()) rows.push_back(group.rows);
    return rows;
}

}  // namespace

TEST_CASE("grouped matrix: has the groups of a dense one, and its entries", "[property]") {
    Random random(3);
    const Matrix A = grouped(random, three);
    GroupedMatrix own = A;
    CHECK(rows_of(own) == three);
    CHECK(own.dense() == A);
    CHECK(own.diagonal() == Vector(A.diagonal()));
    CHECK(own.norm() == Approx(A.norm()).epsilon(1e-15));
    CHECK(own.largest() == A.cwiseAbs().maxCoeff());
    CHECK(own.all_finite());
    // Fewer entries: the groups stay. Others: new ones.
    Matrix diagonal = A.diagonal().asDiagonal();
    own.set(diagonal);
    CHECK(rows_of(own) == three);
    CHECK(own.dense() == diagonal);
    diagonal(0, 1) = 2;
    own.set(diagonal);
    CHECK(rows_of(own) == Groups{{0, 1}, {2}, {3}, {4}, {5}, {6}, {7}});
    CHECK(own.dense() == diagonal);
    diagonal(4, 4) = std::nan("");
    own.set(diagonal);
    CHECK_FALSE(own.all_finite());
    CHECK(GroupedMatrix().rows() == 0);
    CHECK_THROWS_AS(own.set(Matrix::Zero(2, 3)), InputError);
}

TEST_CASE("grouped matrix: sums join groups, joined groups keep the entries", "[property]") {
    Random random(4);
    const Matrix A = grouped(random, three), B = grouped(random, {{0, 1}, {2, 4}, {3}, {5}, {6}, {7}});
    GroupedMatrix own = A;
    own.join({{0, 5}, {3}});
    CHECK(rows_of(own) == three);
    own.join({{1, 7}});
    CHECK(rows_of(own) == Groups{{0, 3, 5}, {1, 2, 4, 6, 7}});
    CHECK(own.dense() == A);
    own = A;
    own.add(B, -2);
    CHECK(rows_of(own) == Groups{{0, 1, 3, 5}, {2, 4, 6, 7}});
    CHECK((own.dense() - (A - 2 * B)).norm() < 1e-15);
    own.add(own, 1);
    own /= 4;
    CHECK((own.dense() - 0.5 * (A - 2 * B)).norm() < 1e-15);
    CHECK_THROWS_AS(own.add(Matrix(Matrix::Identity(3, 3))), InputError);
}

TEST_CASE("grouped matrix: scaled, and solved for group by group", "[property]") {
    Random random(5);
    const Matrix A = grouped(random, three);
    const Vector left = random_matrix(random, 8, 1), right = random_matrix(random, 8, 1);
    GroupedMatrix own = A;
    own.scale(left, right);
    CHECK((own.dense() - left.asDiagonal() * A * right.asDiagonal()).norm() < 1e-14);
    own = A;
    const Matrix b = random_matrix(random, 8, 3);
    Matrix x = b;
    CHECK(own.solve(x));
    CHECK((A * x - b).norm() < 1e-14);
    own.block(1).setZero();
    CHECK_FALSE(own.solve(x));
}

}  // namespace cardan::testing::grouped_matrix_tests
