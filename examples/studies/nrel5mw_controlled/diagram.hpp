/// @file
/// Frequencies and damping over the wind, with the loop open and closed.
#pragma once

#include "examples/studies/nrel5mw_controlled/machine.hpp"

#include <string>

namespace cardan::controlled {

struct DiagramOptions {
    std::string winds = "12,13,14,15,17,19,21,23,25";  ///< m/s, above rated
    double max_frequency = 2.5;                        ///< Hz
};

/// Prints the table of either; writes PREFIX_open.svg and .png, PREFIX_closed.svg and .png.
/// @return exit code: 3, the closed loop does not keep the rated speed, or is not stable
int diagram(const MachineOptions& machine, const DiagramOptions& options, const std::string& out);

}  // namespace cardan::controlled
