/// @file
/// Number of the roots of a system with local states that grow. Internal to solvers: not installed.
#pragma once

#include "solvers/linear/detail/shifted_states.hpp"

#include <optional>
#include <vector>

namespace cardan::solvers {

/// Number of eigenvalues with a real part above `growth` and a magnitude up to `largest` that are not among the known
/// ones, by the argument principle: a turn of det S(lambda) about zero for each of them, and back for each pole, an
/// eigenvalue of f_s, along a half disk. The known roots are divided out, so that what is left turns slowly; the
/// contour is refined until its steps turn by less than a radian.
///
/// Cost some 40 times 2 n^2 l + 3 n^3 complex multiplications (ShiftedStates).
/// @param known   of pairs one: all vibrations that are hardly damped, or the contour's steps may miss whole turns;
/// beyond `largest` they need not be exact
/// @param growth, largest  in the unit of rates of the system, > 0
/// @returns none if the contour passes so close to a root that 400 points do not tell
std::optional<int> growing_roots(const FirstOrderWithStates& system, const std::vector<Complex>& known, double growth,
                                 double largest);

}  // namespace cardan::solvers
