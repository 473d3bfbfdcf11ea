/// @file
/// The gradients of constraints factorised in the metric: projections, multipliers, rank.
#pragma once

#include "mbs/kernels/metric_factor.hpp"

#include <span>
#include <vector>

namespace cardan {

/// Gradients phi_ia of m constraints as an orthonormal basis of what they span in the inverse metric g^ab: the columns
/// of L^-T G^T (g = L^T L), each over its length, decomposed as Q R with exchange of columns.
///
/// Which are independent is asked of the covectors, not of their lengths: a gradient depends on others if what they
/// leave of it is, in the entry of every coordinate, a small fraction of the terms that cancelled there, or rounding.
/// No unit and no mass enters: a light body makes gradients all but parallel in the metric, and they stay independent;
/// a gradient that vanishes at a singular position is dependent, and a redundant one is.
///                                                                               (docs/theory.md, "Closed loops")
///
/// Driven coordinates of the metric's factor move nowhere. Nothing allocates after construction. One object per thread.
class ConstraintFactor {
public:
    /// @param constraints  their number m
    ConstraintFactor(const Model& model, int constraints);

    /// @param metric      factorised at the state; used by the functions below as long as this factor is
    /// @param G           m x n
    /// @param magnitudes  m x n, >= |G|: that the entries may have elsewhere
    /// @param tolerance   a gradient counts as dependent if less than this fraction is left of each of its entries
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
    /// Multipliers with G g^-1 G^T lambda = y. Where they are not unique, those of the minimum norm, each measured by
    /// the length of its gradient in the inverse metric, so that units do not count. Gradients that vanish get none.
    void multipliers(VectorIn y, VectorOut lambda);

private:
    static void orthogonalise(Eigen::Ref<Vector> column, MatrixIn basis, Eigen::Ref<Vector> coefficients);
    void leading_transposed_solve(VectorIn y);
    void set_columns(MatrixIn G, MatrixIn magnitudes, double tolerance);
    void find_spans();
    void exchange(Eigen::Index i, Eigen::Index j);
    void orthogonalise_pivot(bool thorough);
    bool stands_out(MatrixIn magnitudes, double tolerance);
    void complete_images();
    void subtract_pivot_from(Eigen::Index j);
    void factorise_rows();

    MetricFactor* metric_ = nullptr;
    int rank_ = 0;
    Eigen::Index present_ = 0;  ///< columns of gradients that do not vanish; those behind are zero
    std::vector<int> order_;
    std::vector<Eigen::Index> first_, end_;  ///< rows of each column of B between which it may be other than zero
    Matrix B_;                               ///< n x m: columns to come, then Q in the first rank_
    Matrix R_;                               ///< m x m, upper triangular over the columns as exchanged
    Matrix Q2_, T_;                          ///< R^T of the first rank_ rows as Q2 T, where columns depend on others
    Vector length_;                          ///< of the gradients in the inverse metric
    Vector left_;                            ///< squares of what is left of columns
    Vector known_;                           ///< the same when it was last computed from the column
    Eigen::Index images_ = -1;               ///< columns of Q whose covectors are known; -1: nor is the diagonal of g
    Matrix image_;                           ///< n x m: covectors L^T Q
    Vector diagonal_, rest_;                 ///< roots of g_aa; a covector
    Vector w_, z_, sums_;
};

}  // namespace cardan
