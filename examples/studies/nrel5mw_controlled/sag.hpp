/// @file
/// The machine with a doubly-fed generator as a circuit, under the controller, in a sag of the voltage.
#pragma once

#include "examples/studies/nrel5mw_controlled/machine.hpp"

#include <string>

namespace cardan::controlled {

struct SagOptions {
    double wind = 15, depth = 0.5, at = 1, lasts = 0.15;  ///< m/s, -, s, s
    double duration = 6, step = 0.005, tolerance = 1e-6;  ///< s, s, -
};

/// Writes PREFIX.h5, .svg, .png, _energy.png.
/// @return exit code
int sag(const MachineOptions& machine, const SagOptions& options, const std::string& out);

}  // namespace cardan::controlled
