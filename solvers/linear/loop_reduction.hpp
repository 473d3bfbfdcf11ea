/// @file
/// Linearisations on the manifold of positions that close the loops.
#pragma once

#include "solvers/linear/linearise.hpp"

namespace cardan::solvers {

/// The system over independent coordinates: dx = shape dy with G dx = 0, so that M = shape^T M shape and so on.
struct ReducedSystem {
    SecondOrderSystem system;
    Matrix shape;  ///< rows: the coordinates asked for; columns: those of `system`. The identity without loops
};

/// The rows and columns of `coordinates`, with loops over as many of them as are independent: those that move most for
/// the least inertia follow, as pivots of the gradients over the root of their mass. Dependent constraints (below 1e-9
/// of the largest pivot) count once.
/// @throws InputError as restrict_to()
ReducedSystem reduce_loops(const Linearisation& lin, const std::vector<int>& coordinates, int spin = -1);

}  // namespace cardan::solvers
