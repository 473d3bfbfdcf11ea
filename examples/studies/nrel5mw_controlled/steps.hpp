/// @file
/// Steps of the wind through all regions of the controller.
#pragma once

#include "examples/studies/nrel5mw_controlled/machine.hpp"

#include <string>

namespace cardan::controlled {

struct StepsOptions {
    std::string winds = "8,10,11,12,14,17,15,11,9";    ///< m/s
    double every = 60, step = 0.05, tolerance = 1e-6;  ///< s, s, -
    double gain = 0;                                   ///< of the drive-train damper, N m s/rad
};

/// Writes PREFIX.h5, .svg, .png, _energy.png.
/// @return exit code
int steps(const MachineOptions& machine, const StepsOptions& options, const std::string& out);

}  // namespace cardan::controlled
