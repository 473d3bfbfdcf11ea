#include "solvers/dense.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// Eigen copies both factors of a product: depth * 256 * 8 bytes stay below its limit for the stack, 128 KiB.
constexpr Index tile = 256, depth = 48;

// Columns [from, to) of A by elimination with row exchanges, which the other columns and B follow.
void factor_panel(Matrix& A, Matrix& B, Index from, Index to) {
    const Index n = A.rows();
    for (Index k = from; k < to; ++k) {
        Index pivot = 0;
        A.col(k).tail(n - k).cwiseAbs().maxCoeff(&pivot);
        pivot += k;
        if (pivot != k) {
            A.row(k).swap(A.row(pivot));
            B.row(k).swap(B.row(pivot));
        }
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
    for (Index k = 0; k < A.cols(); k += depth)
        for (Index j = 0; j < B.cols(); j += tile)
            for (Index i = 0; i < A.rows(); i += tile) {
                const Index d = std::min(depth, A.cols() - k), columns = std::min(tile, B.cols() - j),
                            rows = std::min(tile, A.rows() - i);
                C.block(i, j, rows, columns).noalias() += sign * A.block(i, k, rows, d) * B.block(k, j, d, columns);
            }
}

void solve_in_place(Matrix& A, Matrix& B) {
    const Index n = A.rows();
    for (Index k = 0; k < n; k += depth) {
        const Index end = std::min(n, k + depth), block = end - k, rest = n - end;
        factor_panel(A, B, k, end);
        for (Index j = end; j < n; ++j) solve_lower(A, k, end, A.col(j).data());
        for (Index j = 0; j < B.cols(); ++j) solve_lower(A, k, end, B.col(j).data());
        add_product(A.bottomRightCorner(rest, rest), A.block(end, k, rest, block), A.block(k, end, block, rest), -1);
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
    for (Index k = 0; k < n; ++k) {
        if (!(A(k, k) > 0)) return false;
        A.col(k).tail(n - k) /= std::sqrt(A(k, k));
        for (Index j = k + 1; j < n; ++j) A.col(j).tail(n - j) -= A(j, k) * A.col(k).tail(n - j);
    }
    return true;
}

}  // namespace cardan::solvers
