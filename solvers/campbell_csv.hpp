/// @file
/// Campbell diagrams as text tables.
#pragma once

#include "solvers/campbell.hpp"

#include <filesystem>

namespace cardan::solvers {

/// One line per rotor speed and mode: rotor_speed[rpm], mode, natural_frequency[Hz], damped_frequency[Hz],
/// damping_ratio[-], mac[-], doubtful[-], mostly[-] (the name that holds most energy there); comment lines begin with
/// #. Ten significant digits.
/// @throws FileError if the path cannot be written or the disk is full
void write_csv(const Campbell& diagram, const std::filesystem::path& path);

}  // namespace cardan::solvers
