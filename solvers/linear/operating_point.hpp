/// @file
/// State of a machine about which it is linearised.
#pragma once

#include "mbs/base/types.hpp"

namespace cardan::solvers {

/// Position, velocity and acceleration of all coordinates at a time.
struct OperatingPoint {
    Vector q, qd, qdd;
    double time = 0;
};

}  // namespace cardan::solvers
