// Optimal assignment of rows to columns.
#include "mbs/base/entry.hpp"
#include "solvers/algebra/assignment.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <numeric>
#include <random>

using namespace cardan;
using namespace cardan::solvers;

namespace {

// Largest sum of scores over all ways to give every row of a wide matrix a column of its own: every permutation of the
// columns is tried, the first rows() of them count.
double best_by_enumeration(const Matrix& score) {
    const Matrix wide = score.rows() <= score.cols() ? score : Matrix(score.transpose());
    std::vector<Eigen::Index> columns(static_cast<std::size_t>(wide.cols()));
    std::iota(columns.begin(), columns.end(), 0);
    double best = -std::numeric_limits<double>::infinity();
    do {
        double sum = 0;
        for (Eigen::Index i = 0; i < wide.rows(); ++i) sum += wide(i, entry(columns, i));
        best = std::max(best, sum);
    } while (std::next_permutation(columns.begin(), columns.end()));
    return best;
}

// Sum of an assignment that uses no column twice and leaves out as few rows as possible.
double checked_sum(const Matrix& score, const std::vector<int>& column_of) {
    REQUIRE(column_of.size() == static_cast<std::size_t>(score.rows()));
    std::vector<int> uses(static_cast<std::size_t>(score.cols()), 0);
    double sum = 0;
    Eigen::Index assigned = 0;
    for (Eigen::Index i = 0; i < score.rows(); ++i) {
        const int column = entry(column_of, i);
        REQUIRE(column >= -1);
        REQUIRE(column < score.cols());
        if (column < 0) continue;
        REQUIRE(++entry(uses, column) == 1);
        sum += score(i, column);
        ++assigned;
    }
    REQUIRE(assigned == std::min(score.rows(), score.cols()));
    return sum;
}

}  // namespace

TEST_CASE("assignment: the sum is the largest of all permutations, on square, wide and tall random matrices",
          "[property]") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> real(-1, 1);
    std::uniform_int_distribution<int> size(1, 6), few(0, 2);
    for (int sample = 0; sample < 400; ++sample) {
        const Eigen::Index rows = size(random), columns = size(random);
        const bool ties = sample % 2 == 0;
        const Matrix score =
            Matrix::NullaryExpr(rows, columns, [&] { return ties ? static_cast<double>(few(random)) : real(random); });
        CAPTURE(score);
        REQUIRE(checked_sum(score, assign(score)) == Approx(best_by_enumeration(score)).margin(1e-13));
    }
}

TEST_CASE("assignment: the best partner of one row is given up where the others need it more", "[analytic]") {
    // By hand: row 0 prefers column 0 (10 against 9), but row 1 has nothing else: 9 + 8 > 10 + 0.
    CHECK(assign((Matrix(2, 2) << 10, 9, 8, 0).finished()) == std::vector<int>{1, 0});
    CHECK(assign((Matrix(3, 1) << 1, 3, 2).finished()) == std::vector<int>{-1, 0, -1});
    CHECK(assign((Matrix(1, 3) << -1, -3, -2).finished()) == std::vector<int>{0});
}

TEST_CASE("assignment: nothing to assign", "[analytic]") {
    CHECK(assign(Matrix(0, 0)).empty());
    CHECK(assign(Matrix(0, 3)).empty());
    CHECK(assign(Matrix(3, 0)) == std::vector<int>{-1, -1, -1});
}
