/// @file
/// The metric factorised on the branches of the tree, g = L^T L, without fill-in.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/kernels/metric.hpp"

#include <span>
#include <string>
#include <string_view>

namespace cardan {

/// Outcome of a factorisation. A pivot that is not positive is a property of the state, not an error: no exception is
/// thrown.
struct [[nodiscard]] PivotStatus {
    int index = -1;                    ///< coordinate of the pivot that is not positive; -1: none
    std::string_view coordinate = {};  ///< its name, valid as long as the model
    double pivot = 0;                  ///< kg m^2 or kg
    double diagonal = 0;               ///< g_aa of that coordinate

    bool ok() const { return index < 0; }
    explicit operator bool() const { return ok(); }
    /// Says what failed and what to do; empty if nothing did.
    std::string message() const;
};

/// g = L^T L with a lower triangular L: L_ab is nonzero only if b lies on the path from the base to a. g has the same
/// pattern (an armature couples coordinates of one branch only), so eliminating the rows from the tips to the base
/// causes no fill-in.                            [Featherstone 2005; Rigid Body Dynamics Algorithms, 2008, section 6.5]
///
/// Driven coordinates are left out: g then stands for the block g_ff of the free ones, and in all vectors the entries
/// of driven coordinates are left unchanged.
///
/// Nothing allocates after construction. The object holds scratch memory, so it serves one thread. Functions throw
/// InputError for arguments of the wrong size or model and for indices out of range.
class MetricFactor {
public:
    /// Driven are the coordinates that have this role in the coordinate table.
    explicit MetricFactor(const Model& model);
    explicit MetricFactor(Model&&) = delete;  // the model must live longer
    /// @param driven  size n; true: left out
    /// @throws InputError if `driven` has another size.
    MetricFactor(const Model& model, std::vector<bool> driven);

    /// @param g  n x n; only g_ba with b on the path of a is read (b <= a, the upper triangle). Cost O(n d^2).
    ///
    /// A pivot must exceed the rounding error of its diagonal element, n eps g_aa; after a failure the factor must not
    /// be used.
    PivotStatus factorise(MatrixIn g);
    PivotStatus factorise(const BranchMatrix& g);
    /// Factorises the metric at `kin`, armatures included. Cost O(n d^2).
    PivotStatus factorise(const Kinematics& kin);

    /// x <- g^-1 x in place, x a vector of size n or an n x m matrix of columns. Cost O(n d) per column.
    void solve(MatrixOut x);
    /// x <- L x. With x = qd the kinetic energy is |L qd|^2 / 2: L qd are rates in an orthonormal frame. Cost O(n d).
    void multiply_L(MatrixOut x);
    /// x <- L^T x. Cost O(n d).
    void multiply_LT(MatrixOut x);
    /// x <- L^-1 x. Cost O(n d).
    void solve_L(MatrixOut x);
    /// x <- L^-T x, the first half of solve(). Cost O(n d).
    void solve_LT(MatrixOut x);
    /// log det g. The unit depends on the coordinates (kg m^2 for every rotation, kg for every translation). Cost O(n).
    double log_determinant() const;

    /// L_ab; zero off the branches and for driven coordinates.
    double operator()(int a, int b) const;
    /// Free coordinates on the path from the base to a, a itself last; empty if a is driven.
    std::span<const int> path(int a) const;
    /// L_ab for b = path(a)[0], path(a)[1], ...
    std::span<const double> row(int a) const;
    /// Number of stored entries, sum over the free coordinates of their depth among the free ones.
    std::size_t stored() const { return values_.size(); }

    const Model& model() const { return *model_; }
    const std::vector<bool>& driven() const { return driven_; }
    bool is_driven(int a) const {
        require_index("metric factor", "coordinate", a, std::ssize(driven_));
        return entry(driven_, a);
    }

private:
    PivotStatus eliminate();
    template <class... Sweeps>
    void apply(MatrixOut& x);

    const Model* model_;
    std::vector<bool> driven_;
    std::vector<std::size_t> offset_;  ///< n + 1; row a holds entries offset_[a] ... offset_[a + 1] - 1
    std::vector<int> paths_;
    std::vector<double> values_, inverse_pivot_;
    BranchMatrix g_;
    std::vector<double> tile_;  ///< right-hand sides side by side
};

}  // namespace cardan
