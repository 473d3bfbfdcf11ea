/// @file
/// Operating points in the wind: the part of `cardan steady` that has air.
#pragma once

#include "examples/shared/command_line.hpp"
#include "examples/shared/machine_file.hpp"
#include <optional>
#include <string>

namespace cardan::program {

/// What the wind is, and how the machine runs in it.
struct WindArguments {
    std::string speeds;                ///< m/s, with ranges; empty: no wind
    std::string air;                   ///< AeroDyn's main file, or windIO; empty: the machine's
    std::string schedule;              ///< file; empty: variable speed
    double shear = 0;                  ///< exponent
    double direction = 0, upflow = 0;  ///< deg
    std::optional<double> density;
    std::optional<double> tip_speed_ratio, rated_power, rated_rpm;  ///< kW
    double least_rpm = 0;
    bool no_skew = false;
};

void add_wind_options(CommandLine& app, WindArguments& arguments);

/// @param harmonics, azimuths  of a revolution
/// @param prefix               of the files
/// @return exit code
int steady_in_wind(const MachineFile& machine, MachineOptions& options, const WindArguments& wind, int harmonics,
                   int azimuths, const std::string& prefix, const CommandLine& command);

}  // namespace cardan::program
