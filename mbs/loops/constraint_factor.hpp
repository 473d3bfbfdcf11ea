/// @file
/// The gradients of constraints factorised in the metric: projections, multipliers, rank.
#pragma once

#include "mbs/kernels/metric_factor.hpp"

#include <span>
#include <vector>

namespace cardan {

/// Gradients phi_ia of m constraints as an orthonormal basis of what they span in the inverse metric g^ab: the columns
/// of L^-T G^T (g = L^T L) decomposed as Q R with exchange of columns, each measured by the length that it would have
/// if nothing cancelled in it. So a gradient that vanishes counts as dependent, and redundant constraints are told from
/// badly scaled ones.
///
/// Driven coordinates of the metric's factor move nowhere. Nothing allocates after construction. One object per thread.
class ConstraintFactor {
public:
    /// @param constraints  their number m
    ConstraintFactor(const Model& model, int constraints);

    /// @param metric      factorised at the state; used by the functions below as long as this factor is
    /// @param G           m x n
    /// @param magnitudes  m x n, >= |G|
    /// @param tolerance   a column counts as dependent if less than this fraction of its full length is left
    /// Cost O(m n d + m^2 n); constraints whose gradients have no coordinates in common cost nothing together.
    void factorise(MetricFactor& metric, MatrixIn G, MatrixIn magnitudes, double tolerance);

    int constraints() const { return static_cast<int>(R_.rows()); }
    int rank() const { return rank_; }
    /// The rank() constraints on which the others depend, most independent first.
    std::span<const int> independent() const { return std::span(order_).first(static_cast<std::size_t>(rank_)); }
    /// The others.
    std::span<const int> dependent() const { return std::span(order_).subspan(static_cast<std::size_t>(rank_)); }

    /// The shortest x, in the metric, with G x = y: x = g^-1 G^T (G g^-1 G^T)^-1 y. Of dependent constraints y is not
    /// read.
    /// @param x  out, size n; zero for driven coordinates
    void shortest(VectorIn y, VectorOut x);
    /// Multipliers with G g^-1 G^T lambda = y, those of the least norm where they are not unique (N and N m count
    /// alike then).
    void multipliers(VectorIn y, VectorOut lambda);

private:
    static void orthogonalise(Eigen::Ref<Vector> column, MatrixIn basis, Eigen::Ref<Vector> coefficients);
    void leading_transposed_solve(VectorIn y);
    void find_spans();
    void orthogonalise_pivot(bool thorough);
    void subtract_pivot_from(Eigen::Index j);

    MetricFactor* metric_ = nullptr;
    int rank_ = 0;
    std::vector<int> order_;
    std::vector<Eigen::Index> first_, end_;  ///< rows of each column of B between which it may be other than zero
    Matrix B_;                               ///< n x m: columns to come, then Q in the first rank_
    Matrix R_;                               ///< m x m, upper triangular over the columns as exchanged
    bool shared_ = false;  ///< dependent constraints take part in what others hold; else their gradients vanish
    Matrix Q2_, T_;        ///< R^T of the first rank_ rows as Q2 T, where they do
    Vector full_;          ///< lengths without cancellation
    Vector left_;          ///< squares of what is left of columns over their full lengths
    Vector known_;         ///< the same when it was last computed from the column
    Vector w_, z_, sums_;
};

}  // namespace cardan
