#include "solvers/algebra/dense.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/sizes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// Eigen copies both factors of a product: depth * 256 * 8 bytes stay below its limit for the stack, 128 KiB.
constexpr Index tile = 256, depth = 48;

// Columns [from, to) of A by elimination with row exchanges, which the other columns follow and `exchanged` is told.
template <class Exchanged>
void factor_panel(Matrix& A, Index from, Index to, Exchanged&& exchanged) {
    const Index n = A.rows();
    for (Index k = from; k < to; ++k) {
        Index pivot = 0;
        A.col(k).tail(n - k).cwiseAbs().maxCoeff(&pivot);
        pivot += k;
        if (pivot != k) A.row(k).swap(A.row(pivot));
        exchanged(k, pivot);
        A.col(k).tail(n - k - 1) /= A(k, k);
        for (Index j = k + 1; j < to; ++j) A.col(j).tail(n - k - 1) -= A(k, j) * A.col(k).tail(n - k - 1);
    }
}

// Rows [from, to) of a column: L^-1 and U^-1 of the diagonal block of A.
void solve_lower(const Matrix& A, Index from, Index to, double* b) {
    for (Index k = from; k < to; ++k)
        for (Index i = k + 1; i < to; ++i) b[i] -= A(i, k) * b[k];
}
void solve_upper(const Matrix& A, Index from, Index to, double* b) {
    for (Index k = to - 1; k >= from; --k) {
        b[k] /= A(k, k);
        for (Index i = from; i < k; ++i) b[i] -= A(i, k) * b[k];
    }
}

}  // namespace

void add_product(MatrixOut C, MatrixIn A, MatrixIn B, double sign) {
    require_size("product", "B", B, A.cols(), B.cols());
    require_size("product", "C", C, A.rows(), B.cols());
    for (Index k = 0; k < A.cols(); k += depth)
        for (Index j = 0; j < B.cols(); j += tile)
            for (Index i = 0; i < A.rows(); i += tile) {
                const Index d = std::min(depth, A.cols() - k), columns = std::min(tile, B.cols() - j),
                            rows = std::min(tile, A.rows() - i);
                C.block(i, j, rows, columns).noalias() += sign * A.block(i, k, rows, d) * B.block(k, j, d, columns);
            }
}

namespace {

// Columns [from, to) of A, and what they leave of the columns behind.
template <class Exchanged>
void eliminate(Matrix& A, Index from, Index to, Exchanged&& exchanged) {
    const Index n = A.rows(), rest = n - to, block = to - from;
    factor_panel(A, from, to, exchanged);
    for (Index j = to; j < n; ++j) solve_lower(A, from, to, A.col(j).data());
    add_product(A.bottomRightCorner(rest, rest), A.block(to, from, rest, block), A.block(from, to, block, rest), -1);
}

}  // namespace

void LuFactors::factorise() {
    const Index n = lu_.rows();
    const auto exchange = [&](Index k, Index pivot) { entry(exchanges_, k) = pivot; };
    for (Index k = 0; k < n; k += depth) eliminate(lu_, k, std::min(n, k + depth), exchange);
}

void LuFactors::solve(Vector& b) const {
    require_size("solution of equations", "b", b, lu_.rows());
    for (Index k = 0; k < b.size(); ++k) std::swap(b(k), b(entry(exchanges_, k)));
    lu_.triangularView<Eigen::UnitLower>().solveInPlace(b);
    lu_.triangularView<Eigen::Upper>().solveInPlace(b);
}

void solve_in_place(Matrix& A, Matrix& B) {
    const Index n = A.rows();
    require_size("solution of equations", "A", A, n, n);
    require_size("solution of equations", "B", B, n, B.cols());
    const auto exchange = [&](Index k, Index pivot) {
        if (pivot != k) B.row(k).swap(B.row(pivot));
    };
    for (Index k = 0; k < n; k += depth) {
        const Index end = std::min(n, k + depth), block = end - k, rest = n - end;
        eliminate(A, k, end, exchange);
        for (Index j = 0; j < B.cols(); ++j) solve_lower(A, k, end, B.col(j).data());
        add_product(B.bottomRows(rest), A.block(end, k, rest, block), B.middleRows(k, block), -1);
    }
    for (Index end = n; end > 0;) {
        const Index k = (end - 1) / depth * depth, block = end - k;
        for (Index j = 0; j < B.cols(); ++j) solve_upper(A, k, end, B.col(j).data());
        add_product(B.topRows(k), A.block(0, k, k, block), B.middleRows(k, block), -1);
        end = k;
    }
}

bool positive_definite(Matrix& A) {
    const Index n = A.rows();
    require_size("positive definite", "A", A, n, n);
    for (Index k = 0; k < n; ++k) {
        if (!(A(k, k) > 0)) return false;
        A.col(k).tail(n - k) /= std::sqrt(A(k, k));
        for (Index j = k + 1; j < n; ++j) A.col(j).tail(n - j) -= A(j, k) * A.col(k).tail(n - j);
    }
    return true;
}

}  // namespace cardan::solvers
