/// @file
/// A matrix with the pattern of the tree, not symmetric, as triangular factors.
#pragma once

#include "mbs/kernels/branch_matrix.hpp"

namespace cardan {

/// A = U L with an upper triangular U, ones on its diagonal, and a lower triangular L, both with the pattern of A:
/// eliminating the coordinates from the tips to the base causes no fill-in, as in MetricFactor. Rows are not exchanged:
/// this is for matrices that their inertial part dominates, as those of implicit time steps.
///
/// Nothing allocates after construction; one object per thread.
class BranchLu {
public:
    explicit BranchLu(const Model& model);
    explicit BranchLu(Model&&) = delete;  // the model must live longer

    /// Fill this before factorise(), which overwrites it.
    BranchMatrix& matrix() { return a_; }
    /// @return false if a pivot has lost ten digits or is not a number: rows would have to be exchanged, and solve()
    /// must not be called.  Cost O(n d^2)
    [[nodiscard]] bool factorise();
    /// x := A^-1 x.  Cost O(n d)
    /// @throws InputError if x has another size than n
    void solve(VectorOut x) const;

private:
    BranchMatrix a_;  ///< the factors: rows L with inverse pivots, columns U
    std::vector<double> diagonal_;
};

}  // namespace cardan
