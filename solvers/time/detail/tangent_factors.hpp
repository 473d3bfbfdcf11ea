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
/// of the full matrix where forces couple branches or a row would have to be exchanged. With states it has a border,
///
///     [        K                  -c_s Q_s      ]
///     [ -c_qd f_qd - c_q f_q   c_sd I - c_s f_s ].
///
/// Groups of states (StateGroup) whose coordinates lie on one path from the base, such as those of the air at a section
/// of a blade, are eliminated first, each by itself: what they add to K has the pattern of the tree. The other m states
/// are eliminated by m solutions with K, which keeps its sparsity whatever they couple.
///
/// With loops a further border holds the accelerations to their constraints,
///
///     [ K  -G^T ] [x]   [r]
///     [ G    0  ] [.] = [y],
///
/// with the independent rows of the gradients G; it is eliminated in the same way.
class TangentFactors {
public:
    explicit TangentFactors(const EquationsOfMotion& equations);

    /// Factors of the rates of the second part of x, of x and, with states, of these.
    struct Factors {
        double qdd, qd, q, s_rate, s;
    };
    /// Factorises the terms as they are now.  Cost O(n d^2), or O(n^3) if it has to be full; with states, O(m n d)
    /// more, and O(k^3 + k d^2) for each group of k that is eliminated first.
    void form(const Factors& c);
    /// r := K^-1 r, by unknowns, then states.  Cost O(n d) or O(n^2)
    void solve(Vector& r);
    /// Solves with loops, y = G v.
    /// @param v  by unknowns
    void solve(Vector& r, const Vector& v);

private:
    // A group that is eliminated first: s = C^-1 (r - R x), and K -= column C^-1 R.
    struct LocalGroup {
        std::vector<int> states, coordinates;  // free ones
        LuFactors C;
        Matrix R;       // then C^-1 R
        Matrix column;  // -c_s Q_s
        Vector r;
    };
    bool is_local(const StateGroup& group) const;
    void set_groups();
    void form_local(const Factors& c);
    /// @param add  adds a value at a pair of coordinates to K
    template <class Add>
    void subtract_local(const Add& add) const;
    void form_border(const Factors& c);
    void form_loops();
    void solve_coordinates(VectorOut r);

    const EquationsOfMotion& equations_;
    BranchLu branches_;
    std::optional<LuFactors> full_;
    bool on_branches_ = true;
    Vector all_;    ///< by coordinates
    Vector right_;  ///< by unknowns
    // With states:
    std::vector<LocalGroup> local_;
    std::vector<int> unknown_;         ///< place among the unknowns, by coordinate; -1: driven
    std::vector<int> bordering_;       ///< the other states
    Matrix columns_, rows_;            ///< K^-1 times the border's columns; its rows
    std::optional<LuFactors> corner_;  ///< what is left of it
    Vector states_;
    // With loops:
    Matrix loop_columns_;  ///< K^-1 of the transposed gradients
    std::optional<LuFactors> loop_corner_;
    Vector multipliers_, column_;
};

}  // namespace cardan::solvers
