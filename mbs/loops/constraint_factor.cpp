#include "mbs/loops/constraint_factor.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/sizes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

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
      full_(constraints),
      left_(constraints),
      known_(constraints),
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
    for (Index j = 0; j < B_.cols(); ++j) {
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

void ConstraintFactor::factorise(MetricFactor& metric, MatrixIn G, MatrixIn magnitudes, double tolerance) {
    constexpr double most_is_gone = 1e-6;  // of the square of the full length
    const Index m = R_.rows(), n = B_.rows();
    require_size("constraints", "gradient", G, m, n);
    require_size("constraints", "magnitudes", magnitudes, m, n);
    metric_ = &metric;
    B_ = G.transpose();
    full_.setZero();
    for (int a = 0; a < n; ++a) {
        if (metric.is_driven(a)) {
            B_.row(a).setZero();
            continue;
        }
        full_.array() += (magnitudes.col(a) / metric(a, a)).array().square();
    }
    full_ = full_.cwiseSqrt();
    metric.solve_LT(B_);
    find_spans();
    std::iota(order_.begin(), order_.end(), 0);
    R_.setZero();
    // Of each column, the square of what is left of it over its full length; where most is gone it is computed afresh.
    const auto left_of = [&](Index j) {
        const double length = full_(entry(order_, j));
        return length > 0 ? B_.col(j).squaredNorm() / (length * length) : 0;
    };
    for (Index j = 0; j < m; ++j) known_(j) = left_(j) = left_of(j);
    for (rank_ = 0; rank_ < m; ++rank_) {
        Index pivot = rank_;
        left_.tail(m - rank_).maxCoeff(&pivot);
        pivot += rank_;
        if (!(left_(pivot) > tolerance * tolerance)) break;
        if (pivot != rank_) {
            std::swap(entry(order_, rank_), entry(order_, pivot));
            B_.col(rank_).swap(B_.col(pivot));
            R_.col(rank_).swap(R_.col(pivot));
            std::swap(left_(rank_), left_(pivot));
            std::swap(known_(rank_), known_(pivot));
            std::swap(entry(first_, rank_), entry(first_, pivot));
            std::swap(entry(end_, rank_), entry(end_, pivot));
        }
        orthogonalise_pivot(left_(rank_) < most_is_gone);
        R_(rank_, rank_) = B_.col(rank_).norm();
        B_.col(rank_) /= R_(rank_, rank_);
        for (Index j = rank_ + 1; j < m; ++j) {
            subtract_pivot_from(j);
            const double part = R_(rank_, j), length = full_(entry(order_, j));
            if (part == 0) continue;
            if (length > 0) left_(j) -= part * part / (length * length);
            if (left_(j) < 1e-4 * known_(j)) known_(j) = left_(j) = left_of(j);
        }
    }
    // As those across the plane of a linkage do, which nothing moves.
    constexpr double vanishes = 1e-14;
    const auto dependents = R_.topRightCorner(rank_, m - rank_);
    shared_ = dependents.size() > 0 && dependents.cwiseAbs().maxCoeff() > vanishes * R_(rank_ - 1, rank_ - 1);
    if (!shared_) return;
    for (Index k = 0; k < rank_; ++k) {
        Q2_.col(k) = R_.row(k).transpose();
        orthogonalise(Q2_.col(k), Q2_.leftCols(k), sums_.head(k));
        T_.col(k).head(k) = sums_.head(k);
        T_(k, k) = Q2_.col(k).norm();
        Q2_.col(k) /= T_(k, k);
    }
}

// w := R11^-T y of the independent constraints.
void ConstraintFactor::leading_transposed_solve(VectorIn y) {
    for (Index k = 0; k < rank_; ++k) w_(k) = (y(entry(order_, k)) - R_.col(k).head(k).dot(w_.head(k))) / R_(k, k);
}

void ConstraintFactor::shortest(VectorIn y, VectorOut x) {
    require_size("constraints", "y", y, R_.rows());
    require_size("constraints", "x", x, B_.rows());
    leading_transposed_solve(y);
    x.setZero();
    for (Index k = 0; k < rank_; ++k) x += w_(k) * B_.col(k);
    metric_->solve_L(x);
}

// With P the exchange, R^T R P^T lambda = P^T y: R P^T lambda = w.
void ConstraintFactor::multipliers(VectorIn y, VectorOut lambda) {
    const Index m = R_.rows(), r = rank_;
    require_size("constraints", "y", y, m);
    require_size("constraints", "lambda", lambda, m);
    leading_transposed_solve(y);
    z_.setZero();
    if (!shared_) {
        for (Index k = r - 1; k >= 0; --k)
            z_(k) = (w_(k) - R_.row(k).segment(k + 1, r - k - 1).dot(z_.segment(k + 1, r - k - 1))) / R_(k, k);
    } else {
        // R = T^T Q2^T: the shortest solution is Q2 T^-T w.
        for (Index k = 0; k < r; ++k) w_(k) = (w_(k) - T_.col(k).head(k).dot(w_.head(k))) / T_(k, k);
        for (Index k = 0; k < r; ++k) z_ += w_(k) * Q2_.col(k);
    }
    for (Index k = 0; k < m; ++k) lambda(entry(order_, k)) = z_(k);
}

}  // namespace cardan
