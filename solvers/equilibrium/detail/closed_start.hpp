/// @file
/// Start of the search for a steady state with loops.
#pragma once

#include "mbs/system/system.hpp"

#include <vector>

namespace cardan::solvers {

/// The closed position next to q; driven coordinates and the spin stay.
/// @throws NumericalError if the loops cannot be closed
Vector closed_position(const System& system, int spin, double time, const Vector& q);

/// State of the loops at a closed position.
struct LoopStart {
    std::vector<int> equations;  ///< those that are independent
    Vector lambda;               ///< multipliers that come nearest to carry the load; zero for the other equations
};
/// @param load  by coordinates: inertial less applied forces, N m or N
LoopStart loop_start(const System& system, int spin, double time, const Vector& q, const Vector& load);

}  // namespace cardan::solvers
