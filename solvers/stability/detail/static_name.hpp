/// @file
/// Names of static motions. Internal: not for users of the library.
#pragma once

#include "solvers/campbell/point.hpp"
#include "solvers/stability/detail/static_roots.hpp"

#include <string>
#include <vector>

namespace cardan::solvers {

/// After the component that takes part most in a root, or after the row that moves most where no spring bends.
/// @param solver  at whose last point the roots are
/// @param k       of the roots
/// @param rows    their names
std::string static_name(const PointSolver& solver, const StaticRoots& roots, int k,
                        const std::vector<std::string>& rows);

}  // namespace cardan::solvers
