/// @file
/// The rotor in linear analyses: how it turns, and what its speed excites.
#pragma once

#include <cstdint>
#include <vector>

namespace cardan::solvers {

/// The spin coordinate of the rotor: free in the linearised system (its zero pair is left out), or prescribed.
enum class RotorSpin : std::uint8_t { free, prescribed };

/// Multiples n of the rotor speed that are plotted and searched for crossings: 1, 2, 3 and B, 2B, 3B, 4B; for two
/// blades 1, 2, 4, 6.
std::vector<int> rotor_multiples(int blades);

}  // namespace cardan::solvers
