/// @file
/// The tangent of an implicit step as triangular factors. For sources only.
#pragma once

#include "mbs/kernels/branch_lu.hpp"
#include "solvers/algebra/dense.hpp"
#include "solvers/time/equations_of_motion.hpp"

#include <optional>

namespace cardan::solvers {

/// K = c_qdd g + c_qd C + c_q S of the terms of EquationsOfMotion::linearise(): factors on the branches of the tree, or
/// of the full matrix where forces couple branches or a row would have to be exchanged.
class TangentFactors {
public:
    explicit TangentFactors(const EquationsOfMotion& equations);

    /// Of the terms as they are now.  Cost O(n d^2), or O(n^3) if it has to be full.
    void form(double c_qdd, double c_qd, double c_q);
    /// r := K^-1 r, by unknowns.  Cost O(n d) or O(n^2)
    void solve(Vector& r);

private:
    const EquationsOfMotion& equations_;
    BranchLu branches_;
    std::optional<LuFactors> full_;
    bool on_branches_ = true;
    Vector all_;  ///< by coordinates
};

}  // namespace cardan::solvers
