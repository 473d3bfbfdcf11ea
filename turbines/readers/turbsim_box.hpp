/// @file
/// TurbSim's full-field files.
#pragma once

#include "turbines/readers/wind_box_file.hpp"

namespace cardan::turbines {

/// Reads a .bts of TurbSim: mean wind and turbulence on a grid and, where it has them, on points of the tower. Periodic
/// if it says so (8 at its beginning); else (7) its first plane is half the grid's width upwind at t = 0, as InflowWind
/// has it, and the wind ends with the last one.
/// @throws FileError, with the place in the file, for what is no such file, is cut or too long, and for values out of
/// range
WindBoxFile read_turbsim_box(const std::filesystem::path& path);

}  // namespace cardan::turbines
