/// @file
/// Component modes of one machine or blade among those of another. Internal: not for users of the library.
#pragma once

#include "solvers/mode_names/energy_shares.hpp"

#include <optional>
#include <vector>

namespace cardan::solvers {

/// Place of every component that is wanted among those that are there, by part, family and ordinal; where names differ
/// (pitch turns what is flap and edge of a clamped blade, but not its modes), those of a part follow each other in
/// frequency.
/// @return none: a part has not as many there
std::optional<std::vector<std::size_t>> component_order(const std::vector<Component>& wanted,
                                                        const std::vector<Component>& there);

}  // namespace cardan::solvers
