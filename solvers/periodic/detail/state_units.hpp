/// @file
/// Units in which the states of a linear periodic system are alike in size.
#pragma once

#include "solvers/periodic/periodic_system.hpp"

namespace cardan::solvers {

/// Of x = (q, q', s) of a system of second order at time 0: coordinates of unit inertia, rates by 2 pi / T, states by
/// their scales times one factor that makes what they do to the coordinates as large as what these do to them. Ones for
/// a system of first order.
/// @param place  names the caller
/// @throws InputError for a row without inertia
Vector units_of_states(const PeriodicSystem& system, const char* place);

}  // namespace cardan::solvers
