#include "solvers/algebra/dense.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/sizes.hpp"
#include "solvers/algebra/detail/block_product.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// Panels of so many columns are eliminated one column after the other.
constexpr Index narrow = 8;

double* at(Matrix& A, Index row, Index column) {
    return A.data() + row + column * A.rows();
}

// The part of columns [to, last) beside and below the factors that stand in columns [from, to).
void follow(Matrix& A, Index from, Index to, Index last) {
    const Index n = A.rows(), block = to - from;
    solve_unit_lower(block, at(A, from, from), n, last - to, at(A, from, to), n);
    add_block_product(n - to, last - to, block, -1, at(A, to, from), n, at(A, from, to), n, at(A, to, to), n);
}

// Columns [from, to) of A, `product_depth` of them at most, by elimination with row exchanges, which the other columns
// follow and `exchanged` is told.
template <class Exchanged>
void factor_panel(Matrix& A, Index from, Index to, Exchanged&& exchanged) {
    if (to - from > narrow) {
        const Index middle = from + (to - from) / 2;
        factor_panel(A, from, middle, exchanged);
        follow(A, from, middle, to);
        factor_panel(A, middle, to, exchanged);
        return;
    }
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

// A = L U in place.
template <class Exchanged>
void factor(Matrix& A, Exchanged&& exchanged) {
    const Index n = A.rows();
    for (Index k = 0; k < n; k += product_depth) {
        const Index end = std::min(n, k + product_depth);
        factor_panel(A, k, end, exchanged);
        follow(A, k, end, n);
    }
}

// B := L^-1 B and U^-1 B, block by block of the factors.
void solve_lower_factor(const Matrix& A, double* B, Index columns) {
    const Index n = A.rows();
    if (columns == 0) return;  // B may have no memory then
    for (Index k = 0; k < n; k += product_depth) {
        const Index block = std::min(product_depth, n - k), end = k + block;
        solve_unit_lower(block, A.data() + k * (n + 1), n, columns, B + k, n);
        add_block_product(n - end, columns, block, -1, A.data() + end + k * n, n, B + k, n, B + end, n);
    }
}
void solve_upper_factor(const Matrix& A, double* B, Index columns) {
    const Index n = A.rows();
    if (columns == 0) return;
    for (Index end = n; end > 0;) {
        const Index k = (end - 1) / product_depth * product_depth, block = end - k;
        solve_upper(block, A.data() + k * (n + 1), n, columns, B + k, n);
        add_block_product(k, columns, block, -1, A.data() + k * n, n, B + k, n, B, n);
        end = k;
    }
}

}  // namespace

void add_product(MatrixOut C, MatrixIn A, MatrixIn B, double sign) {
    require_size("product", "B", B, A.cols(), B.cols());
    require_size("product", "C", C, A.rows(), B.cols());
    if (C.size() == 0) return;  // what is empty may have no memory
    for (Index k = 0; k < A.cols(); k += product_depth)
        add_block_product(A.rows(), B.cols(), std::min(product_depth, A.cols() - k), sign,
                          A.data() + k * A.outerStride(), A.outerStride(), B.data() + k, B.outerStride(), C.data(),
                          C.outerStride());
}

void LuFactors::factorise() {
    factor(lu_, [&](Index k, Index pivot) { entry(exchanges_, k) = pivot; });
}

bool LuFactors::regular() const {
    return lu_.diagonal().allFinite() && (lu_.diagonal().array() != 0).all();
}

double LuFactors::pivot_ratio() const {
    if (lu_.rows() == 0) return 1;
    const auto pivots = lu_.diagonal().array().abs();
    if (!pivots.allFinite()) return std::numeric_limits<double>::quiet_NaN();
    return pivots.maxCoeff() > 0 ? pivots.minCoeff() / pivots.maxCoeff() : 0;
}

void LuFactors::solve_transposed(Matrix& B) const {
    for (Index j = 0; j < B.cols(); ++j) solve_transposed_column(B.col(j).data(), B.rows());
}

// A = P^T L U: A^-T = P^T L^-T U^-T.
void LuFactors::solve_transposed_column(double* data, Index size) const {
    require_size("solution of equations", "b", Eigen::Map<Vector>(data, size), lu_.rows());
    Eigen::Map<Vector> b(data, size);
    for (Index k = 0; k < size; ++k) b(k) = (b(k) - lu_.col(k).head(k).dot(b.head(k))) / lu_(k, k);
    for (Index k = size - 1; k >= 0; --k) b(k) -= lu_.col(k).tail(size - k - 1).dot(b.tail(size - k - 1));
    for (Index k = size - 1; k >= 0; --k) std::swap(b(k), b(entry(exchanges_, k)));
}

void LuFactors::solve(Vector& b) const {
    require_size("solution of equations", "b", b, lu_.rows());
    for (Index k = 0; k < b.size(); ++k) std::swap(b(k), b(entry(exchanges_, k)));
    solve_unit_lower(b.size(), lu_.data(), lu_.rows(), 1, b.data(), b.size());
    solve_upper(b.size(), lu_.data(), lu_.rows(), 1, b.data(), b.size());
}

void LuFactors::solve(Matrix& B) const {
    require_size("solution of equations", "B", B, lu_.rows(), B.cols());
    for (Index k = 0; k < B.rows(); ++k)
        if (const Index other = entry(exchanges_, k); other != k) B.row(k).swap(B.row(other));
    solve_lower_factor(lu_, B.data(), B.cols());
    solve_upper_factor(lu_, B.data(), B.cols());
}

void solve_in_place(Matrix& A, Matrix& B) {
    const Index n = A.rows();
    require_size("solution of equations", "A", A, n, n);
    require_size("solution of equations", "B", B, n, B.cols());
    factor(A, [&](Index k, Index pivot) {
        if (pivot != k) B.row(k).swap(B.row(pivot));
    });
    solve_lower_factor(A, B.data(), B.cols());
    solve_upper_factor(A, B.data(), B.cols());
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
