/// @file
/// Linearisations on the manifold of positions that close the loops.
#pragma once

#include "solvers/linear/linearise.hpp"

namespace cardan::solvers {

/// As many of some coordinates as are independent where G dx = 0; the others follow. Those that move most for the least
/// inertia do: pivots of the gradients over the root of the mass. Dependent constraints (below 1e-9 of the largest
/// pivot) count once. All of them without loops.
/// @throws InputError for coordinates out of range
std::vector<int> independent_coordinates(const Linearisation& lin, const std::vector<int>& coordinates);

/// How coordinates follow those that are independent: G shape = 0.
/// @param constraints  G, by all coordinates
/// @param independent  some of `coordinates`
/// @returns one row for each of `coordinates`, one column for each of `independent`
/// @throws NumericalError where those do not determine the others, as at a dead point
Matrix following(const Matrix& constraints, const std::vector<int>& coordinates, const std::vector<int>& independent);

/// The system over independent coordinates: dx = shape dy, so that M = shape^T M shape and so on.
struct ReducedSystem {
    SecondOrderSystem system;
    Matrix shape;  ///< rows: the coordinates asked for; columns: those of `system`. The identity without loops
};

/// The rows and columns of `coordinates`, with loops over as many of them as are independent.
/// @throws as above and as restrict_to()
ReducedSystem reduce_loops(const Linearisation& lin, const std::vector<int>& coordinates, int spin = -1);

/// A linearisation without constraints instead: what belongs to coordinates that follow is moved to those that are
/// independent, and their own rows and columns become zero. For analyses of the independent coordinates that know trees
/// only.
/// @param coordinates  those that may move; all others stay as they are
void condense_loops(Linearisation& lin, const std::vector<int>& coordinates, const std::vector<int>& independent);

}  // namespace cardan::solvers
