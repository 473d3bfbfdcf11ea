/// @file
/// The 600 kW machine with its circuit in time: a direct start, and disturbances of the grid.
#pragma once

#include "programs/shared/simulation_run.hpp"

namespace cardan::electric {

struct MotionOptions {
    program::RunArguments run;  ///< duration 0: that of the study
    int blade_elements = 3, tower_elements = 3;
    int order = 5;
    double wind = 11.86, at = 1, lasts = 0.15, depth = 0.5;
};

/// @param study  "start", "loss" or "sag"
/// @return exit code
int motion(const std::string& study, const MotionOptions& given);

}  // namespace cardan::electric
