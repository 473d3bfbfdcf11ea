/// @file
/// Where a machine is and how it moves: what it is linearised about.
#pragma once

#include "mbs/base/types.hpp"

namespace cardan::solvers {

/// Position, velocity and acceleration of all coordinates at a time.
struct OperatingPoint {
    Vector q, qd, qdd;
    double time = 0;
};

}  // namespace cardan::solvers
