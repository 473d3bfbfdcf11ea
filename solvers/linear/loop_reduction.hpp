/// @file
/// Linearisations on the manifold of positions that close the loops.
#pragma once

#include "solvers/linear/linearise.hpp"

namespace cardan::solvers {

/// Independent coordinates among some, where G dx = 0; the others follow. Those that move most for the least inertia
/// do: pivots of the gradients over the root of the mass, each gradient over its length. Dependent constraints (below
/// 1e-9 of the largest pivot) count once. All of them without loops.
/// @param preferred  a coordinate that is independent wherever the others can follow it, such as the spin; -1: none
/// @throws InputError for coordinates out of range
std::vector<int> independent_coordinates(const Linearisation& lin, const std::vector<int>& coordinates,
                                         int preferred = -1);

/// Matrix by which coordinates follow those that are independent: G shape = 0.
/// @param constraints  G, by all coordinates
/// @param independent  some of `coordinates`
/// @returns one row for each of `coordinates`, one column for each of `independent`
/// @throws NumericalError where those do not determine the others, as at a dead point
Matrix following(const Matrix& constraints, const std::vector<int>& coordinates, const std::vector<int>& independent);

/// Measure of how well the independent coordinates determine the others: smallest over largest pivot, 0 at a dead
/// point.
double following_quality(const Matrix& constraints, const std::vector<int>& coordinates,
                         const std::vector<int>& independent);

/// Coordinates among some that are independent all along a way: those that the others follow best where they follow
/// worst.
/// @param way  linearisations on it
/// @throws as independent_coordinates(); NumericalError where no choice passes every dead point on the way
std::vector<int> independent_on_the_way(const std::vector<Linearisation>& way, const std::vector<int>& coordinates,
                                        int preferred = -1);

/// Motion of dependent coordinates along a motion, where the gradients change with time:
///
///     dx = shape dy,  dx' = shape dy' + rate dy,  dx'' = shape dy'' + 2 rate dy' + acceleration dy .
struct Followers {
    Matrix shape;
    Matrix rate, acceleration;  ///< empty of a linearisation at rest
};
/// @throws as above
Followers followers(const Linearisation& lin, const std::vector<int>& coordinates, const std::vector<int>& independent);

/// Motion of dependent coordinates for that of the others: G_d x = -right, the shortest x.
/// @param right  G times what the others do
Matrix follow(const Matrix& constraints, const std::vector<int>& dependent, const Matrix& right);
/// Multipliers with G^T lambda = load on some coordinates, the shortest, each measured by its gradient there.
Matrix multipliers_on(const Matrix& constraints, const std::vector<int>& coordinates, const Matrix& load);

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
/// only. Where loops move, what deviations of the independent ones cause by the motion is among `inertial`,
/// `gyroscopic` and `loads`.
/// @param coordinates  those that may move; all others stay as they are
void condense_loops(Linearisation& lin, const std::vector<int>& coordinates, const std::vector<int>& independent);

}  // namespace cardan::solvers
