/// @file
/// Optimal assignment of rows to columns.
#pragma once

#include "mbs/base/types.hpp"

namespace cardan::solvers {

/// Column for every row such that the sum of score(row, column) is largest; every column is used at most once; -1 where
/// there are more rows than columns. Shortest augmenting paths (Kuhn 1955, Jonker and Volgenant 1987), O(rows^2
/// columns). Boost.Graph has matchings of general graphs only, dlib integer scores of square matrices.
std::vector<int> assign(const Matrix& score);

}  // namespace cardan::solvers
