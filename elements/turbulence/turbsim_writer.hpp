/// @file
/// Boxes as files that other programs read.
#pragma once

#include "elements/turbulence/turbulence_box.hpp"
#include "elements/wind/wind.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace cardan {

/// The contents of a file of TurbSim beside the turbulence.
struct TurbsimFile {
    SteadyWind mean;       ///< is added at every point; without direction, veer and upflow, as the box lies across it
    std::string text;      ///< what the file says of itself, at most 200 characters of ASCII
    bool periodic = true;  ///< said to readers: whether the first step follows the last one
    /// Whether there are points below the grid, a row's spacing apart, down to the ground: for the wind on the tower.
    /// They have the turbulence of the lowest row's middle and the mean wind at their own height.
    bool tower = false;
};

/// Writes a full-field file of TurbSim (.bts) that InflowWind and others read [B. J. Jonkman, TurbSim User's Guide v2,
/// NREL (2016), appendix "TurbSim output file format"]: numbers of 16 bits over the range of each component, that is
/// within 1/131 070 of the range of what the box and the mean have. The same box makes the same bytes.
/// @throws InputError for a mean with a direction, a text out of range, a box with fewer than 2 steps, rows or columns,
/// a speed that is not positive, a lowest point below ground or values that are not finite; FileError
void write_turbsim(const std::filesystem::path& path, const TurbulenceBox& box, const TurbsimFile& file);

}  // namespace cardan
