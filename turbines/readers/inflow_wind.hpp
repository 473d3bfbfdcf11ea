/// @file
/// Winds from files: InflowWind of OpenFAST, steady, uniform over time and turbulent, and tables of our own.
#pragma once

#include "elements/wind/wind.hpp"
#include "turbines/readers/turbine_file.hpp"
#include "turbines/readers/wind_box_file.hpp"

#include <filesystem>
#include <vector>

namespace cardan::turbines {

struct InflowWindFile {
    Wind wind = SteadyWind{};
    std::vector<FileNote> notes = {};
};

/// Reads InflowWind's main file, of any age, with the files that it names: steady wind with a power law (WindType 1),
/// such winds over time (2) with horizontal and linear shear, vertical speed and gusts, and boxes of TurbSim (3), of
/// Bladed's kind with a summary (4), HAWC2 (5) and Bladed (7, which has angles of its own); turned by PropagationDir
/// and VFlowAng. A user-defined wind (6) is refused.
/// @param density  of the air, kg/m^3
/// @param order    of the planes of HAWC2's boxes; InflowWind begins with the first
/// @throws ParseError, FileError
InflowWindFile read_inflow_wind(const std::filesystem::path& path, double density = 1.225,
                                PlaneOrder order = PlaneOrder::first_first);

/// A CSV table with time[s],speed[m/s] and, where they are not zero, direction[deg] (to the left), upflow[deg],
/// exponent[-] of the power law, gradient[1/m] over the height, lateral[1/m], gust[m/s], vertical[m/s].
/// @param steady  for what the table does not have
/// @throws ParseError, FileError
Wind read_wind_table(const std::filesystem::path& path, const SteadyWind& steady);

}  // namespace cardan::turbines
