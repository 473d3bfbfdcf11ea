/// @file
/// Modes of the machine on the free spar, beside those with the spar held and on land.
#pragma once

#include "examples/studies/nrel5mw_floating/machine.hpp"

namespace cardan::floating {

struct ModesOptions {
    std::string rpm = "0,6,12.1", names = "community";
    double max_frequency = 4;
    bool shapes = false, summary = false;
};

/// The whole study; writes PREFIX.h5, .csv, .svg, .png, _families.png and _difference.png.
/// @return exit code
int free_modes(const MachineOptions& machine, const ModesOptions& options, const std::string& prefix);

}  // namespace cardan::floating
