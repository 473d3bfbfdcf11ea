/// @file
/// Eigenvalues as a free motion in time shows them.
#pragma once

#include "mbs/base/types.hpp"

#include <vector>

namespace cardan::controlled {

/// A part c exp(eigenvalue t) of a motion.
struct FreeMotion {
    Complex eigenvalue;  ///< 1/s
    Complex amplitude;   ///< c, of the first sample
};

/// A motion y_k at equal steps as a sum of `order` such parts and a constant. Prony's method on the differences
/// y_(k+1) - y_k: their recursion by least squares, its roots, amplitudes by least squares.    [Hildebrand 1956, ch. 9]
/// @param step  s
/// @returns parts by falling amplitude
/// @throws InputError for fewer than three samples per part
std::vector<FreeMotion> prony(const std::vector<double>& samples, double step, int order);

/// The largest of them that oscillates.  @throws NumericalError if none does
FreeMotion largest_oscillation(const std::vector<FreeMotion>& parts);

}  // namespace cardan::controlled
