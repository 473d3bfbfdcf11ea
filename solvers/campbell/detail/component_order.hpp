/// @file
/// Component modes of one machine among those of another. Internal: not for users of the library.
#pragma once

#include "solvers/campbell/energy_shares.hpp"

#include <optional>
#include <vector>

namespace cardan::solvers {

/// Place of every component that is wanted among those that are there, by part, family and ordinal.
/// @param same_beams  the machines differ in how their blades are set only: pitch turns what is flap and edge of a
/// clamped
///                    blade, but not its modes, and where names differ those of a part follow each other in frequency
/// @return none: the components are not the same
std::optional<std::vector<std::size_t>> component_order(const std::vector<Component>& wanted,
                                                        const std::vector<Component>& there, bool same_beams);

}  // namespace cardan::solvers
