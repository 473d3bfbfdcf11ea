/// @file
/// Operating points in the wind: the part of `cardan steady` that has air.
#pragma once

#include "programs/cardan/revolution.hpp"
#include "programs/cardan/wind_options.hpp"
#include <string>

namespace cardan::program {

/// @param prefix  of the files
/// @return exit code
int steady_in_wind(const turbines::Machine& machine, MachineOptions& options, const WindArguments& wind,
                   const RevolutionOptions& revolution, const std::string& prefix, const CommandLine& command);

}  // namespace cardan::program
