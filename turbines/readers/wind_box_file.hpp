/// @file
/// Turbulent winds from files, whose numbers stay where they are: mapped, not copied.
#pragma once

#include "elements/wind/wind.hpp"
#include "elements/wind/wind_box.hpp"
#include "turbines/readers/turbine_file.hpp"

#include <filesystem>
#include <memory>
#include <vector>

namespace cardan::turbines {

/// A turbulent wind that was read.
struct WindBoxFile {
    std::shared_ptr<const WindBox> box;
    /// Mean wind to be added to the box; its speed is 0 where the box holds the mean wind. Its reference height is that
    /// of the files, about which the wind is turned (Wind::turned()).
    SteadyWind mean = {};
    double direction = 0;  ///< by which the files turn all of it, to the left, rad
    double upflow = 0;     ///< likewise, upward, rad
    std::vector<FileNote> notes = {};
};

/// Reads a file by what it begins with: TurbSim's .bts (read_turbsim_box()), a .wnd of Bladed's kind with its .sum
/// beside it (read_bladed_box()), or the text that names a .wnd of Bladed itself (read_native_bladed_box()).
/// @throws FileError, ParseError
WindBoxFile read_wind_box(const std::filesystem::path& path);
/// Whether a file is one of these by its beginning; InflowWind's main file is none.
/// @throws FileError
bool is_wind_box(const std::filesystem::path& path);

}  // namespace cardan::turbines
