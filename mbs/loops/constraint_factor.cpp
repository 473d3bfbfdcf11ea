#include "mbs/loops/constraint_factor.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardan {

using Index = Eigen::Index;

ConstraintFactor::ConstraintFactor(const Model& model, int constraints)
    : order_(static_cast<std::size_t>(constraints)),
      first_(order_.size()),
      end_(order_.size()),
      B_(model.size(), constraints),
      R_(constraints, constraints),
      Q2_(constraints, constraints),
      T_(constraints, constraints),
      length_(constraints),
      left_(constraints),
      known_(constraints),
      image_(model.size(), constraints),
      diagonal_(model.size()),
      rest_(model.size()),
      w_(constraints),
      z_(constraints),
      sums_(constraints) {}

// Gram and Schmidt's method, twice: then the basis is orthogonal to the last digit.              [Giraud et al. 2005]
void ConstraintFactor::orthogonalise(Eigen::Ref<Vector> column, MatrixIn basis, Eigen::Ref<Vector> coefficients) {
    coefficients.setZero();
    for (int pass = 0; pass < 2; ++pass)
        for (Index i = 0; i < basis.cols(); ++i) {
            const double part = basis.col(i).dot(column);
            column -= part * basis.col(i);
            coefficients(i) += part;
        }
}

// Of loops far apart the gradients have different coordinates, and so have the columns: it pays to know where.
void ConstraintFactor::find_spans() {
    const Index n = B_.rows();
    for (Index j = 0; j < present_; ++j) {
        Index first = 0, end = n;
        while (first < n && B_(first, j) == 0) ++first;
        while (end > first && B_(end - 1, j) == 0) --end;
        entry(first_, j) = first;
        entry(end_, j) = end;
    }
}

// Once more against the basis, whose parts were subtracted one by one: against those columns of which there was a part,
// or, where most of the column is gone, all.
void ConstraintFactor::orthogonalise_pivot(bool thorough) {
    for (int pass = 0; pass < 2; ++pass)
        for (Index i = 0; i < rank_; ++i) {
            if (!thorough && R_(i, rank_) == 0) continue;
            const Index first = entry(first_, i), size = entry(end_, i) - first;
            const double part = B_.col(i).segment(first, size).dot(B_.col(rank_).segment(first, size));
            B_.col(rank_).segment(first, size) -= part * B_.col(i).segment(first, size);
            R_(i, rank_) += part;
            entry(first_, rank_) = std::min(entry(first_, rank_), first);
            entry(end_, rank_) = std::max(entry(end_, rank_), first + size);
        }
}

void ConstraintFactor::subtract_pivot_from(Index j) {
    const Index first = std::max(entry(first_, rank_), entry(first_, j)),
                size = std::min(entry(end_, rank_), entry(end_, j)) - first;
    if (size <= 0) return;
    const double part = B_.col(rank_).segment(first, size).dot(B_.col(j).segment(first, size));
    if (part == 0) return;
    const Index from = entry(first_, rank_), length = entry(end_, rank_) - from;
    B_.col(j).segment(from, length) -= part * B_.col(rank_).segment(from, length);
    entry(first_, j) = std::min(entry(first_, j), from);
    entry(end_, j) = std::max(entry(end_, j), from + length);
    R_(rank_, j) = part;
}

// Of gradients that do not vanish, in their order; the others follow, in theirs.
void ConstraintFactor::set_columns(MatrixIn G, MatrixIn magnitudes, double tolerance) {
    const Index m = R_.rows(), n = B_.rows();
    const std::vector<bool>& driven = metric_->driven();
    const auto vanishes = [&](Index i) {
        for (Index a = 0; a < n; ++a)
            if (std::abs(G(i, a)) > tolerance * magnitudes(i, a) && !entry(driven, a)) return false;
        return true;
    };
    B_.setZero();
    present_ = 0;
    Index behind = m;
    for (Index i = 0; i < m; ++i) {
        if (vanishes(i)) {
            entry(order_, --behind) = static_cast<int>(i);
            continue;
        }
        B_.col(present_) = G.row(i).transpose();
        entry(order_, present_++) = static_cast<int>(i);
    }
    std::reverse(order_.begin() + behind, order_.end());
    for (Index a = 0; a < n; ++a)
        if (entry(driven, a)) B_.row(a).setZero();
    metric_->solve_LT(B_.leftCols(present_));
    for (Index j = 0; j < present_; ++j) {
        length_(j) = B_.col(j).norm();
        B_.col(j) /= length_(j);
    }
    find_spans();
}

void ConstraintFactor::exchange(Index i, Index j) {
    if (i == j) return;
    B_.col(i).swap(B_.col(j));
    R_.col(i).swap(R_.col(j));
    for (Vector* v : {&length_, &left_, &known_}) std::swap((*v)(i), (*v)(j));
    std::swap(entry(order_, i), entry(order_, j));
    std::swap(entry(first_, i), entry(first_, j));
    std::swap(entry(end_, i), entry(end_, j));
}

// Covectors L^T q of the basis.
void ConstraintFactor::complete_images() {
    if (images_ < 0) {
        images_ = 0;
        diagonal_.setZero();
        for (int b = 0; b < diagonal_.size(); ++b) {
            const std::span<const int> path = metric_->path(b);
            const std::span<const double> row = metric_->row(b);
            for (std::size_t i = 0; i < path.size(); ++i) diagonal_(path[i]) += row[i] * row[i];
        }
        diagonal_ = diagonal_.cwiseSqrt();
    }
    for (; images_ < rank_; ++images_) {
        image_.col(images_) = B_.col(images_);
        metric_->multiply_LT(image_.col(images_));
    }
}

// Is what the basis leaves of the pivot more than a fraction of what cancelled, in the entry of any coordinate? In the
// metric what is left has an error of rounding times the sum of the parts that were subtracted, each over the sine of
// the column it belongs to; an entry has at most that times the root of g_aa.
bool ConstraintFactor::stands_out(MatrixIn magnitudes, double tolerance) {
    constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
    complete_images();
    rest_ = B_.col(rank_);
    metric_->multiply_LT(rest_);
    double error = rounding;
    for (Index k = 0; k < rank_; ++k) error += rounding * std::abs(R_(k, rank_)) / R_(k, k);
    for (Index a = 0; a < rest_.size(); ++a) {
        const double left = std::abs(rest_(a));
        if (!(left > error * diagonal_(a)) || metric_->is_driven(static_cast<int>(a))) continue;
        double full = magnitudes(entry(order_, rank_), a) / length_(rank_);
        for (Index k = 0; k < rank_; ++k) full += std::abs(R_(k, rank_) * image_(a, k));
        if (left > tolerance * full) return true;
    }
    return false;
}

void ConstraintFactor::factorise(MetricFactor& metric, MatrixIn G, MatrixIn magnitudes, double tolerance) {
    constexpr double in_doubt = 1e-2;  // square of the sine of the angle to what the others span
    const Index m = R_.rows(), n = B_.rows();
    require_size("constraints", "gradient", G, m, n);
    require_size("constraints", "magnitudes", magnitudes, m, n);
    metric_ = &metric;
    images_ = -1;
    set_columns(G, magnitudes, tolerance);
    R_.setZero();
    left_.setOnes();
    known_.setOnes();
    // Those that may still be independent are rank_ ... open - 1; dependent ones gather behind.
    Index open = present_;
    for (rank_ = 0; rank_ < open;) {
        Index pivot = 0;
        left_.segment(rank_, open - rank_).maxCoeff(&pivot);
        exchange(rank_, rank_ + pivot);
        const bool doubtful = left_(rank_) < in_doubt;
        orthogonalise_pivot(doubtful);
        if (doubtful && !stands_out(magnitudes, tolerance)) {
            exchange(rank_, --open);
            continue;
        }
        R_(rank_, rank_) = B_.col(rank_).norm();
        B_.col(rank_) /= R_(rank_, rank_);
        for (Index j = rank_ + 1; j < present_; ++j) {
            subtract_pivot_from(j);
            const double part = R_(rank_, j);
            left_(j) -= part * part;
            // Where most is gone it is computed afresh.
            if (part != 0 && left_(j) < 1e-4 * known_(j)) known_(j) = left_(j) = B_.col(j).squaredNorm();
        }
        ++rank_;
    }
    if (present_ > rank_) factorise_rows();
}

void ConstraintFactor::factorise_rows() {
    for (Index k = 0; k < rank_; ++k) {
        Q2_.col(k) = R_.row(k).transpose();
        orthogonalise(Q2_.col(k), Q2_.leftCols(k), sums_.head(k));
        T_.col(k).head(k) = sums_.head(k);
        T_(k, k) = Q2_.col(k).norm();
        Q2_.col(k) /= T_(k, k);
    }
}

// w := R11^-T y of the independent constraints, y over the lengths of their gradients.
void ConstraintFactor::leading_transposed_solve(VectorIn y) {
    for (Index k = 0; k < rank_; ++k)
        w_(k) = (y(entry(order_, k)) / length_(k) - R_.col(k).head(k).dot(w_.head(k))) / R_(k, k);
}

void ConstraintFactor::shortest(VectorIn y, VectorOut x) {
    require_size("constraints", "y", y, R_.rows());
    require_size("constraints", "x", x, B_.rows());
    leading_transposed_solve(y);
    x.setZero();
    for (Index k = 0; k < rank_; ++k) x += w_(k) * B_.col(k);
    metric_->solve_L(x);
}

// With P the exchange and lambda times the lengths for lambda, R^T R P^T lambda = P^T y: R P^T lambda = w.
void ConstraintFactor::multipliers(VectorIn y, VectorOut lambda) {
    const Index m = R_.rows(), r = rank_;
    require_size("constraints", "y", y, m);
    require_size("constraints", "lambda", lambda, m);
    leading_transposed_solve(y);
    z_.setZero();
    if (present_ == r) {
        for (Index k = r - 1; k >= 0; --k)
            z_(k) = (w_(k) - R_.row(k).segment(k + 1, r - k - 1).dot(z_.segment(k + 1, r - k - 1))) / R_(k, k);
    } else {
        // R = T^T Q2^T: the shortest solution is Q2 T^-T w.
        for (Index k = 0; k < r; ++k) w_(k) = (w_(k) - T_.col(k).head(k).dot(w_.head(k))) / T_(k, k);
        for (Index k = 0; k < r; ++k) z_ += w_(k) * Q2_.col(k);
    }
    lambda.setZero();
    for (Index k = 0; k < present_; ++k) lambda(entry(order_, k)) = z_(k) / length_(k);
}

}  // namespace cardan
