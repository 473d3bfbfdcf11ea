#include "solvers/algebra/real_eigen.hpp"

#include "mbs/base/sizes.hpp"

#include <Eigen/Householder>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// Never zero: a double eigenvalue without a second eigenvector gets the first one again.
Complex at_least(Complex pivot, double small) {
    return std::abs(pivot) < small ? Complex(small) : pivot;
}

}  // namespace

RealEigen::RealEigen(Index size, Index rows)
    : hessenberg_(std::max<Index>(size, 1)),
      T_(size, size),
      Z_(rows, size),
      vectors_(rows, size),
      y_(size, 2),
      row_(rows) {
    values_.reserve(static_cast<std::size_t>(size));
}

// T = Q^T A Q, and the first rows of Q = H_0 H_1 ... in Z.
void RealEigen::reduce_to_hessenberg(const Matrix& A) {
    const Index n = A.rows();
    hessenberg_.compute(A);
    const auto& packed = hessenberg_.packedMatrix();
    const auto& tau = hessenberg_.householderCoefficients();
    T_ = packed;
    for (Index j = 0; j + 2 < n; ++j) T_.col(j).tail(n - j - 2).setZero();
    Z_.setIdentity();
    for (Index k = 0; k + 2 < n; ++k)
        Z_.rightCols(n - k - 1).applyHouseholderOnTheRight(packed.col(k).tail(n - k - 2), tau(k), row_.data());
}

bool RealEigen::compute(const Matrix& A) {
    const Index n = A.rows();
    require_size("eigenvalues", "A", A, T_.rows(), T_.rows());
    values_.clear();
    if (n == 0) return true;
    reduce_to_hessenberg(A);
    if (!schur_.reduce(T_, Z_)) return false;
    small_ = std::numeric_limits<double>::epsilon() * std::max(T_.cwiseAbs().maxCoeff(), 1e-140);
    for (Index j = 0; j < n; ++j) {
        const bool pair = j + 1 < n && T_(j + 1, j) != 0;
        Complex mu = T_(j, j);
        if (pair) {
            const double p = 0.5 * (T_(j, j) - T_(j + 1, j + 1));
            mu = {T_(j + 1, j + 1) + p, std::sqrt(std::abs(p * p + T_(j + 1, j) * T_(j, j + 1)))};
        }
        values_.push_back({mu, j});
        back_substitute(mu, j);
        const Index used = pair ? j + 2 : j + 1;
        vectors_.col(j).noalias() = Z_.leftCols(used) * y_.col(0).head(used);
        if (pair) vectors_.col(++j).noalias() = Z_.leftCols(used) * y_.col(1).head(used);
    }
    return true;
}

// (T - mu) y = 0 from the block of mu, which begins at row `top`, upwards.
void RealEigen::back_substitute(Complex mu, Index top) {
    y_.setZero();
    if (mu.imag() == 0) {
        set_y(top, 1);
    } else {
        // The larger of the two rows of the block decides.
        const double b = T_(top, top + 1), c = T_(top + 1, top);
        const bool first = std::abs(b) > std::abs(c);
        set_y(top, first ? Complex(b) : mu - T_(top + 1, top + 1));
        set_y(top + 1, first ? mu - T_(top, top) : Complex(c));
        subtract_column(top + 1, top);
    }
    subtract_column(top, top);
    for (Index i = top - 1; i >= 0; --i) {
        if (i > 0 && T_(i, i - 1) != 0)
            eliminate_pair(mu, i--);
        else
            eliminate(mu, i);
        // Nearly equal eigenvalues make vectors grow; their length is free.
        const double size = std::max(std::abs(y_(i, 0)), std::abs(y_(i, 1)));
        if (size > 1e100) y_ /= size;
    }
}

void RealEigen::eliminate(Complex mu, Index i) {
    set_y(i, y(i) / at_least(T_(i, i) - mu, small_));
    subtract_column(i, i);
}

// Rows i - 1 and i belong to a complex pair.
void RealEigen::eliminate_pair(Complex mu, Index i) {
    const Complex a = T_(i - 1, i - 1) - mu, d = T_(i, i) - mu, r = y(i - 1), s = y(i);
    const double b = T_(i - 1, i), c = T_(i, i - 1);
    const Complex determinant = at_least(a * d - b * c, small_ * small_);
    set_y(i - 1, (r * d - b * s) / determinant);
    set_y(i, (a * s - c * r) / determinant);
    subtract_column(i, i - 1);
    subtract_column(i - 1, i - 1);
}

// y(rows above) -= T(rows above, i) y(i)
void RealEigen::subtract_column(Index i, Index above) {
    y_.col(0).head(above) -= y_(i, 0) * T_.col(i).head(above);
    if (y_(i, 1) != 0) y_.col(1).head(above) -= y_(i, 1) * T_.col(i).head(above);
}

}  // namespace cardan::solvers
