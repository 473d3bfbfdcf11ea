/// @file
/// Winds from files: InflowWind of OpenFAST, steady and uniform over time, and tables of our own.
#pragma once

#include "elements/wind/wind.hpp"
#include "turbines/readers/turbine_file.hpp"

#include <filesystem>
#include <vector>

namespace cardan::turbines {

struct InflowWindFile {
    Wind wind = SteadyWind{};
    std::vector<FileNote> notes = {};
};

/// InflowWind of WindType 1, speed at a height with a power law, or 2, a file of such winds over time; direction and
/// upflow. Taken as they are: horizontal and linear shear, vertical speed, gusts.
/// @param density  of the air, kg/m^3
/// @throws ParseError, FileError; other kinds of wind are refused
InflowWindFile read_inflow_wind(const std::filesystem::path& path, double density = 1.225);

/// A CSV table with time[s],speed[m/s] and, where they are not zero, direction[deg] (to the left), upflow[deg],
/// exponent[-] of the power law, gradient[1/m] over the height, lateral[1/m], gust[m/s], vertical[m/s].
/// @param steady  for what the table does not have
/// @throws ParseError, FileError
Wind read_wind_table(const std::filesystem::path& path, const SteadyWind& steady);

}  // namespace cardan::turbines
