#include "solvers/periodic/detail/harmonic_factors.hpp"

#include "mbs/base/entry.hpp"

namespace cardan::solvers {

using Index = Eigen::Index;

HarmonicFactors::HarmonicFactors(const Matrix& A, const Matrix& B, const std::vector<std::vector<Index>>& groups)
    : coordinates_(A.rows()), complex_(B.size() > 0) {
    for (const std::vector<Index>& rows : groups) coordinates_ -= std::ssize(rows);
    const Index n = coordinates_, m = A.rows() - n;
    Matrix A_qq = A.topLeftCorner(n, n), B_qq = complex_ ? Matrix(B.topLeftCorner(n, n)) : Matrix();
    if (m > 0) {
        groups_.reserve(groups.size());
        for (const std::vector<Index>& rows : groups) {
            groups_.push_back({rows, Factors(embedded(A(rows, rows), complex_ ? Matrix(B(rows, rows)) : Matrix()))});
            if (!(reciprocal_condition(groups_.back().factors) > 0)) return;
        }
        A_qs_ = A.topRightCorner(n, m);
        Matrix right = Matrix::Zero(A.rows(), complex_ ? 2 * n : n);  // c and s of P_sq, its columns side by side
        right.bottomLeftCorner(m, n) = A.bottomLeftCorner(m, n);
        if (complex_) {
            // A force that a state makes at once has none.
            if (const auto own = B.topRightCorner(n, m); !own.isZero(0)) B_qs_ = own;
            right.bottomRightCorner(m, n) = -B.bottomLeftCorner(m, n);
        }
        const Matrix X = solved_states(right);
        if (!X.allFinite()) return;
        A_X_ = X.leftCols(n);
        A_qq.noalias() -= A_qs_ * A_X_;
        if (complex_) {
            B_X_ = -X.rightCols(n);
            B_qq.noalias() -= A_qs_ * B_X_;
            if (B_qs_.size() > 0) {
                A_qq.noalias() += B_qs_ * B_X_;
                B_qq.noalias() -= B_qs_ * A_X_;
            }
        }
    }
    if (n > 0) of_coordinates_ = Factors(embedded(A_qq, B_qq));
    rcond_ = n > 0 ? reciprocal_condition(of_coordinates_) : 1;
}

Matrix HarmonicFactors::embedded(const Matrix& A, const Matrix& B) const {
    if (!complex_) return A;
    Matrix out(2 * A.rows(), 2 * A.cols());
    out << A, B, -B, A;
    return out;
}

// P_ss^-1 r_s, by group. With complex numbers the first half of the columns is c, the other one s.
Matrix HarmonicFactors::solved_states(const Matrix& r) const {
    const Index columns = complex_ ? r.cols() / 2 : r.cols();
    Matrix out(r.rows() - coordinates_, r.cols());
    Matrix own;
    for (const Group& group : groups_) {
        const Index size = std::ssize(group.rows);
        own.resize(complex_ ? 2 * size : size, columns);
        own.topRows(size) = r(group.rows, Eigen::seqN(0, columns));
        if (complex_) own.bottomRows(size) = r(group.rows, Eigen::seqN(columns, columns));
        own = group.factors.solve(own);
        for (Index i = 0; i < size; ++i) {
            const Index row = entry(group.rows, i) - coordinates_;
            out.row(row).head(columns) = own.row(i);
            if (complex_) out.row(row).tail(columns) = own.row(size + i);
        }
    }
    return out;
}

// r -= (A + i B) z: (A + i B)(c - i s) = (A c + B s) - i (A s - B c).
void HarmonicFactors::subtract_product(const Matrix& A, const Matrix& B, const Matrix& z, Matrix& r) const {
    r.noalias() -= A * z;
    if (B.size() == 0) return;
    r.col(0).noalias() -= B * z.col(1);
    r.col(1).noalias() += B * z.col(0);
}

void HarmonicFactors::solve(Matrix& r) const {
    const Index n = coordinates_, m = r.rows() - n;
    Matrix z_q = r.topRows(n), z_s;
    if (m > 0) {
        z_s = solved_states(r);
        subtract_product(A_qs_, B_qs_, z_s, z_q);
    }
    if (n > 0) z_q = Matrix(of_coordinates_.solve(Vector(z_q.reshaped()))).reshaped(n, r.cols());
    r.topRows(n) = z_q;
    if (m == 0) return;
    subtract_product(A_X_, B_X_, z_q, z_s);
    r.bottomRows(m) = z_s;
}

}  // namespace cardan::solvers
