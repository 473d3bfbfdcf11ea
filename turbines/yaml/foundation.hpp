/// @file
/// Foundations of towers, as 6 x 6 matrices at the tower base.
#pragma once

#include "turbines/model/platform.hpp"

#include <filesystem>
#include <string>

namespace cardan::turbines {

/// YAML with the keys `stiffness` (N/m, N, N m/rad) and, if they are not zero, `mass` (kg, kg m, kg m^2) and `damping`
/// (N s/m ...): symmetric 6 x 6 matrices, six lists of six numbers. Rows and columns are surge, sway, heave, roll,
/// pitch, yaw of the tower's foot: displacements along x downwind, y = z x x, z up, and rotations about these axes.
/// `.inf` on the diagonal of the stiffness: that direction is held, and the rest of its row and column is not used.
/// @throws FileError, ParseError: another key, a matrix of another size or not symmetric, a stiffness that is not
/// positive definite; InputError as PlatformDescription::check()
PlatformDescription read_foundation(const std::filesystem::path& path);
/// @param file  name for messages
PlatformDescription parse_foundation(const std::string& text, const std::string& file);

}  // namespace cardan::turbines
