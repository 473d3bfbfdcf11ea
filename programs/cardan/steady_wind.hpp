/// @file
/// Operating points in the wind: the part of `cardan steady` that has air.
#pragma once

#include "programs/cardan/revolution.hpp"
#include "programs/cardan/wind_options.hpp"

#include <initializer_list>
#include <string>
#include <vector>

namespace cardan::program {

/// Endings of what it writes.
inline const std::initializer_list<const char*> wind_outputs{".h5",
                                                             ".csv",
                                                             "_sections.csv",
                                                             ".svg",
                                                             ".png",
                                                             "_sections.svg",
                                                             "_sections.png",
                                                             "_coefficients.svg",
                                                             "_coefficients.png"};

/// @param winds   winds_of()
/// @param prefix  of the files
/// @return exit code
int steady_in_wind(const turbines::Machine& machine, MachineOptions& options, const WindArguments& wind,
                   const std::vector<double>& winds, const RevolutionOptions& revolution, const std::string& prefix,
                   const CommandLine& command);

}  // namespace cardan::program
