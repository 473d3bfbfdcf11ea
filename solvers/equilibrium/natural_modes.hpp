/// @file
/// Natural modes of a system in one call: equilibrium or steady rotation, linearisation, eigenvalues.
#pragma once

#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/linear/modes.hpp"

namespace cardan::solvers {

struct NaturalModes {
    DynamicState at;            ///< the steady state they belong to
    std::vector<int> unknowns;  ///< model index of every row of the shapes
    std::vector<Mode> modes;    ///< by natural frequency; see modes()
};

/// Small vibrations about the equilibrium at rest, or about steady rotation in the rotating frame.
/// With loops they are those of the closed machine; shapes are those of all coordinates all the same.
/// @param start        where the search for the steady state begins, size n; empty: zero. With loops, a position from
///                     which they close as they should
/// @param spin         model index of the coordinate that rotates, its rotation prescribed; -1: none
/// @param rotor_speed  its rate, rad/s
/// @throws InputError if there is no such coordinate or nothing can move; NumericalError if no steady state is found,
/// or if it is periodic (gravity across the axis): then use Floquet theory
NaturalModes natural_modes(const System& system, int spin = -1, double rotor_speed = 0, const Vector& start = {});

}  // namespace cardan::solvers
