/// @file
/// The modes up to a frequency, where few of many are wanted.
#pragma once

#include "solvers/linear/modes.hpp"

namespace cardan::solvers {

/// The modes of ModeSolver with |eigenvalue| <= `largest`, in its order: oscillations, then aperiodic ones.
/// Shift-invert Arnoldi (dominant_eigenvalues()) with the shift of ModeSolver, so that low modes come out as exactly as
/// there; the dense solver for small systems, and where a Krylov space of half of all states does not suffice. NREL 5
/// MW with 176 unknowns: 7 ms instead of 47 for the 16 modes below 4 Hz.
/// @param largest  rad/s; > 0
/// @throws InputError, NumericalError as ModeSolver::solve()
std::vector<Mode> lowest_modes(const SecondOrderSystem& system, double largest);

}  // namespace cardan::solvers
