#include "solvers/linear_models/detail/shifted_schur.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <utility>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

double default_shift(const Matrix& A) {
    const Eigen::EigenSolver<Matrix> solver(A, false);
    if (solver.info() != Eigen::Success) throw NumericalError("state matrix: the eigenvalue iteration fails");
    Vector sizes = solver.eigenvalues().cwiseAbs();
    std::sort(sizes.begin(), sizes.end());
    const double largest = sizes.size() > 0 ? sizes(sizes.size() - 1) : 0;
    if (largest == 0) return 1;
    // Zero eigenvalues come out with the size of the largest entry times rounding.
    const auto rises = [&](double size) { return size > std::max(1e-8 * largest, 1e-5); };
    const auto first = std::find_if(sizes.begin(), sizes.end(), rises);
    const auto tenth = sizes.begin() + sizes.size() / 10;
    // Not a round number, which an unstable real eigenvalue might be.
    return 1.0371 * (first == sizes.end() ? largest : *std::max(first, tenth));
}

// Exchanges the eigenvalues number i and i + 1 of an upper triangular T = U^H S U.  [Golub and Van Loan, 7.6.2]
void exchange(ComplexMatrix& T, ComplexMatrix& U, Index i) {
    const Complex x = T(i, i + 1), y = T(i + 1, i + 1) - T(i, i);
    const double length = std::hypot(std::abs(x), std::abs(y));
    if (length == 0) return;
    Eigen::Matrix2cd G;  // first column: eigenvector of the lower one
    G << x / length, -std::conj(y) / length, y / length, std::conj(x) / length;
    const Complex upper = T(i, i), lower = T(i + 1, i + 1);
    T.middleRows(i, 2) = (G.adjoint() * T.middleRows(i, 2)).eval();
    T.middleCols(i, 2) = (T.middleCols(i, 2) * G).eval();
    U.middleCols(i, 2) = (U.middleCols(i, 2) * G).eval();
    T(i, i) = lower;
    T(i + 1, i + 1) = upper;
    T(i + 1, i) = 0;
}

}  // namespace

ShiftedSchur::ShiftedSchur(const Matrix& A, double sigma) : sigma_(sigma) {
    if (!A.allFinite()) throw NumericalError("state matrix: an entry is not finite");
    if (sigma_ == 0) sigma_ = default_shift(A);
    Matrix shifted = A;
    shifted.diagonal().array() -= sigma_;
    inverse_ = shifted.partialPivLu().inverse();
    if (!inverse_.allFinite())
        throw NumericalError(text("state matrix: the shift ", sigma_, " 1/s is one of its eigenvalues"));
    const Eigen::ComplexSchur<ComplexMatrix> schur(ComplexMatrix(inverse_.cast<Complex>()));
    if (schur.info() != Eigen::Success) throw NumericalError("state matrix: Schur's iteration fails");
    T_ = schur.matrixT();
    U_ = schur.matrixU();
}

// With A = sigma + S^-1, S = U T U^H, and the equation multiplied by S and S^T from both sides:
//   2 sigma T Y T^H + T Y + Y T^H = -U^H S Q S^T U,  X = U Y U^H.
// Column j depends on those after it.
Matrix ShiftedSchur::lyapunov(const Matrix& Q) const {
    const Index n = size();
    if (Q.rows() != n || Q.cols() != n)
        throw InputError("Lyapunov's equation", "size of Q", text(Q.rows(), " x ", Q.cols()), text(n, " x ", n));
    const Matrix right = inverse_ * Q * inverse_.transpose();
    const ComplexMatrix F = U_.adjoint() * right.cast<Complex>() * U_;
    ComplexMatrix Y = ComplexMatrix::Zero(n, n);
    for (Index j = n - 1; j >= 0; --j) {
        const Index after = n - 1 - j;
        const ComplexVector w = Y.rightCols(after) * T_.row(j).tail(after).adjoint();
        const Complex t = std::conj(T_(j, j));
        ComplexMatrix factor = (2 * sigma_ * t + 1.0) * T_;
        factor.diagonal().array() += t;
        const ComplexVector Tw = T_.triangularView<Eigen::Upper>() * w;
        ComplexVector b = -F.col(j) - w - 2 * sigma_ * Tw;
        factor.triangularView<Eigen::Upper>().solveInPlace(b);
        Y.col(j) = b;
    }
    if (!Y.allFinite()) throw NumericalError("Lyapunov's equation: two eigenvalues add up to zero");
    const Matrix X = (U_ * Y * U_.adjoint()).real();
    return (X + X.transpose()) / 2;
}

Matrix ShiftedSchur::subspace(std::vector<bool> chosen) const {
    const Index n = size(), count = std::count(chosen.begin(), chosen.end(), true);
    if (count == 0) return Matrix(n, 0);
    ComplexMatrix T = T_, U = U_;
    for (Index target = 0; target < count; ++target) {
        Index at = target;
        while (!entry(chosen, at)) ++at;
        for (; at > target; --at) {
            exchange(T, U, at - 1);
            std::vector<bool>::swap(entry(chosen, at), entry(chosen, at - 1));
        }
    }
    // The span is closed under conjugation: real and imaginary parts of its basis span it over the real numbers.
    Matrix parts(n, 2 * count);
    parts << U.leftCols(count).real(), U.leftCols(count).imag();
    return orthogonal_factor(parts.colPivHouseholderQr()).leftCols(count);
}

namespace {

// Conjugates differ by rounding: both go where the one above the real axis goes, also at the edge of a choice.
std::vector<bool> by_pairs(const ShiftedSchur& schur, const std::function<bool(Complex)>& first) {
    std::vector<bool> chosen;
    for (Index i = 0; i < schur.size(); ++i) {
        const Complex own = schur.eigenvalue(i);
        Complex other = own;
        for (Index j = 0; j < schur.size(); ++j)
            if (std::abs(schur.eigenvalue(j) - std::conj(own)) < std::abs(other - std::conj(own)))
                other = schur.eigenvalue(j);
        chosen.push_back(first(own.imag() < other.imag() ? other : own));
    }
    return chosen;
}

}  // namespace

Decoupled decouple(const Matrix& A, const ShiftedSchur& schur, const std::function<bool(Complex)>& first) {
    const Index n = schur.size();
    const std::vector<bool> in_first = by_pairs(schur, first);
    std::vector<bool> in_second = in_first;
    in_second.flip();
    Decoupled d;
    d.right_1 = schur.subspace(in_first);
    d.right_2 = schur.subspace(in_second);
    Matrix basis(n, n);
    basis << d.right_1, d.right_2;
    const Matrix inverse = basis.partialPivLu().inverse();
    d.left_1 = inverse.topRows(d.right_1.cols());
    d.left_2 = inverse.bottomRows(d.right_2.cols());
    // Through (A - sigma)^-1, as the subspaces were found.
    Matrix shifted = A;
    shifted.diagonal().array() -= schur.sigma();
    const auto lu = shifted.partialPivLu();
    const auto block = [&](const Matrix& left, const Matrix& right) {
        const Index k = right.cols();
        if (k == 0) return Matrix(0, 0);
        Matrix own = Matrix(left * lu.solve(right)).partialPivLu().inverse();
        own.diagonal().array() += schur.sigma();
        return own;
    };
    d.A_1 = block(d.left_1, d.right_1);
    d.A_2 = block(d.left_2, d.right_2);
    return d;
}

}  // namespace cardan::solvers
