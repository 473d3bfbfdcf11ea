/// @file
/// Rows of a matrix that couple with one another.
#pragma once

#include "mbs/base/types.hpp"

#include <vector>

namespace cardan::solvers {

/// Rows of states that couple with one another, directly or through others: all of them, each in one group. Local
/// states, such as those of the air on a section, make many small ones.
/// @param A      square
/// @param first  row of the first state
std::vector<std::vector<Eigen::Index>> coupled_groups(const Matrix& A, Eigen::Index first);

}  // namespace cardan::solvers
