/// @file
/// Operating points in the wind: the part of `cardan steady` that has air.
#pragma once

#include "examples/programs/cardan/air.hpp"
#include "examples/programs/cardan/revolution.hpp"
#include <optional>
#include <string>

namespace cardan::program {

/// What the wind is, and how the machine runs in it.
struct WindArguments {
    std::string speeds;    ///< m/s, with ranges; empty: no wind
    std::string schedule;  ///< file; empty: variable speed
    AirArguments air;
    std::optional<double> tip_speed_ratio, rated_power, rated_rpm;  ///< kW
    double least_rpm = 0;
};

void add_wind_options(CommandLine& app, WindArguments& arguments);

/// @param prefix  of the files
/// @return exit code
int steady_in_wind(const MachineFile& machine, MachineOptions& options, const WindArguments& wind,
                   const RevolutionOptions& revolution, const std::string& prefix, const CommandLine& command);

}  // namespace cardan::program
