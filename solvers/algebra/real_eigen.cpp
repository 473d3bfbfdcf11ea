#include "solvers/algebra/real_eigen.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/sizes.hpp"

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

struct RealEigen::Hessenberg {
    Hessenberg(Index size, Index rows) : form(size), row(rows) {}

    // T = Q^T A Q, Z := Z Q
    void reduce(const Matrix& A, Matrix& T, Matrix& Z) {
        form.compute(A);
        T = form.matrixH();
        form.matrixQ().applyThisOnTheRight(Z, row);
    }

    Eigen::HessenbergDecomposition<Matrix> form;
    Eigen::RowVectorXd row;
};

RealEigen::RealEigen(Index size, Index rows)
    : hessenberg_(std::make_unique<Hessenberg>(size, rows)),
      T_(size, size),
      Z_(rows, size),
      vectors_(rows, size),
      y_(size, 2) {
    values_.reserve(static_cast<std::size_t>(size));
}

RealEigen::~RealEigen() = default;

bool RealEigen::compute(const Matrix& A) {
    const Index n = A.rows();
    require_size("eigenvalues", "A", A, T_.rows(), T_.rows());
    values_.clear();
    if (n == 0) return true;
    Z_.setIdentity();  // the first rows of Q
    hessenberg_->reduce(A, T_, Z_);
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

// A double eigenvalue whose blocks are coupled by rounding only has two vectors. Divided by a difference that is
// rounding too, that coupling would make them any mixture, nearly parallel at times.
bool RealEigen::is_rounding(Complex value) const {
    constexpr double errors = 100;
    return std::abs(value) < errors * small_;
}

// (T - mu) y = 0 from the block of mu, which begins at row `top`, upwards.
void RealEigen::back_substitute(Complex mu, Index top) {
    y_.setZero();
    size_ = 1;
    if (mu.imag() == 0) {
        set_y(top, 1);
    } else {
        // The larger of the two rows of the block decides.
        const double b = T_(top, top + 1), c = T_(top + 1, top);
        const bool first = std::abs(b) > std::abs(c);
        set_y(top, first ? Complex(b) : mu - T_(top + 1, top + 1));
        set_y(top + 1, first ? mu - T_(top, top) : Complex(c));
        size_ = std::max(std::abs(y(top)), std::abs(y(top + 1)));
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
        size_ = std::max(size_, size);
        if (size > 1e100) y_ /= size, size_ /= size;
    }
}

void RealEigen::eliminate(Complex mu, Index i) {
    const Complex pivot = T_(i, i) - mu;
    set_y(i, is_rounding(pivot) && is_rounding(y(i) / size_) ? 0 : y(i) / at_least(pivot, small_));
    subtract_column(i, i);
}

// Rows i - 1 and i belong to a complex pair.
void RealEigen::eliminate_pair(Complex mu, Index i) {
    const Complex a = T_(i - 1, i - 1) - mu, d = T_(i, i) - mu, r = y(i - 1), s = y(i);
    const double b = T_(i - 1, i), c = T_(i, i - 1);
    const Complex exact = a * d - b * c, upper = r * d - b * s, lower = a * s - c * r;
    // The determinant is (nu - mu) (conj nu - mu) of the block's own nu; of a block of rank one the pseudo-inverse.
    const double apart = 2 * mu.imag();
    const auto vanishes = [&](Complex x, double size) { return apart != 0 && is_rounding(x / (apart * size)); };
    if (vanishes(exact, 1) && vanishes(upper, size_) && vanishes(lower, size_)) {
        const double norm = std::norm(a) + b * b + c * c + std::norm(d);
        set_y(i - 1, (std::conj(a) * r + c * s) / norm);
        set_y(i, (b * r + std::conj(d) * s) / norm);
    } else {
        const Complex determinant = at_least(exact, small_ * small_);
        set_y(i - 1, upper / determinant);
        set_y(i, lower / determinant);
    }
    subtract_column(i, i - 1);
    subtract_column(i - 1, i - 1);
}

// y(rows above) -= T(rows above, i) y(i)
void RealEigen::subtract_column(Index i, Index above) {
    y_.col(0).head(above) -= y_(i, 0) * T_.col(i).head(above);
    if (y_(i, 1) != 0) y_.col(1).head(above) -= y_(i, 1) * T_.col(i).head(above);
}

}  // namespace cardan::solvers
