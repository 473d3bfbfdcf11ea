/// @file
/// Turbulent winds of Bladed's kind (.wnd): those of TurbSim for InflowWind, with a summary beside them, and those of
/// Bladed itself, with a text that says how to scale them.
#pragma once

#include "turbines/readers/wind_box_file.hpp"

namespace cardan::turbines {

/// Whether there are points of the tower in a file of their own, .twr, beside a .wnd.
enum class TowerFile : std::uint8_t { none, beside };

/// Reads a .wnd together with the .sum of the same name beside it (InflowWind's WindType 4), which holds mean wind and
/// turbulence. Headers: -99 with the turbulence 1, 2 (u alone), 3, 5, 4, 7, 8; and the old -1, -2, -3, minus the number
/// of components. Components that are not there are zero. Turbulence intensities of the header count before those of
/// the .sum. A box that is not periodic starts half its width upwind, as InflowWind has it.
/// @throws FileError with the place in the .wnd, ParseError with the line of the .sum
WindBoxFile read_bladed_box(const std::filesystem::path& path, TowerFile tower = TowerFile::none);

/// Reads the text that names a .wnd of Bladed (InflowWind's WindType 7): words and their values,
///
///     UBAR 12           mean speed at the reference height, m/s
///     REFHT 90          reference height and middle of the grid, m
///     TI 0.16           intensity of the turbulence along the wind; TI_V, TI_W: across it and upward
///     WDIR 0            direction, clockwise from above, rad
///     FLINC 0           upflow, rad
///     WINDF "box.wnd"   the file
///     WSHEAR 0.2        exponent of the power law
///
/// and where they are not 0 VLINSHEAR, HLINSHEAR (linear changes over REFLENGTH upward and to the left, over UBAR) and
/// XOffset (x of the first plane at t = 0, m). Each component is scaled to its intensity at the middle point, of an
/// even number the lower or the right one; v of the file points to the right. Periodic; below the grid the turbulence
/// goes linearly to zero at the ground.
/// @throws ParseError, FileError
WindBoxFile read_native_bladed_box(const std::filesystem::path& path);

}  // namespace cardan::turbines
