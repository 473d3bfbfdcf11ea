/// @file
/// A linear periodic system in units in which its states are alike in size.
#pragma once

#include "solvers/periodic/periodic_system.hpp"

namespace cardan::solvers {

/// Units of x = (q, q', s) of a system of second order at time 0: coordinates of unit inertia, rates by 2 pi / T,
/// states by their scales times one factor that makes what they do to the coordinates as large as what these do to
/// them. Ones for a system of first order.
/// @param place  names the caller
/// @throws InputError for a row without inertia
Vector units_of_states(const PeriodicSystem& system, const char* place);

/// A system in these units and in the time omega t.
struct NormalisedSystem {
    /// @throws as units_of_states()
    NormalisedSystem(const PeriodicSystem& raw, const char* place);
    PeriodicSystem system;
    Vector unit;  ///< states of `raw` over those of `system`
};

}  // namespace cardan::solvers
