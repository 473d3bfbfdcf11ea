/// @file
/// State of a machine about which it is linearised.
#pragma once

#include "mbs/base/types.hpp"

namespace cardan::solvers {

/// Position, velocity and acceleration of all coordinates at a time, with the states beside them and the inputs.
struct OperatingPoint {
    Vector q, qd, qdd;
    double time = 0;
    Vector s = {};       ///< Forces::states(); empty: as their table says
    Vector u = {};       ///< Forces::inputs(); empty: as their table says
    Vector lambda = {};  ///< multipliers of the loops, Loops::equations(); empty: zero
};

}  // namespace cardan::solvers
