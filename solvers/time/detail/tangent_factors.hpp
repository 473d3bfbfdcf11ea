/// @file
/// The tangent of an implicit step as triangular factors. For sources only.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/kernels/branch_lu.hpp"
#include "solvers/algebra/dense.hpp"
#include "solvers/time/equations_of_motion.hpp"

#include <optional>

namespace cardan::solvers {

/// K = c_qdd g + c_qd C + c_q S of the terms of EquationsOfMotion::linearise(): factors on the branches of the tree, or
/// of the full matrix where forces couple branches or a row would have to be exchanged. With m states it has a border,
///
///     [        K                  -c_s Q_s      ]
///     [ -c_qd f_qd - c_q f_q   c_sd I - c_s f_s ]
///
/// which is eliminated by m solutions with K: K keeps its sparsity whatever the states couple.
class TangentFactors {
public:
    explicit TangentFactors(const EquationsOfMotion& equations);

    /// Factors of the rates of the second part of x, of x and, with states, of these.
    struct Factors {
        double qdd, qd, q, s_rate, s;
    };
    /// Of the terms as they are now.  Cost O(n d^2), or O(n^3) if it has to be full; with states, O(m n d) more.
    void form(const Factors& c);
    /// r := K^-1 r, by unknowns, then states.  Cost O(n d) or O(n^2)
    void solve(Vector& r);

private:
    void form_border(const Factors& c);
    void solve_coordinates(VectorOut r);

    const EquationsOfMotion& equations_;
    BranchLu branches_;
    std::optional<LuFactors> full_;
    bool on_branches_ = true;
    Vector all_;    ///< by coordinates
    Vector right_;  ///< by unknowns
    // With states:
    Matrix columns_, rows_;            ///< K^-1 times the border's columns; its rows
    std::optional<LuFactors> corner_;  ///< what is left of it
    Vector states_;
};

}  // namespace cardan::solvers
