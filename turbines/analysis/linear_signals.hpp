/// @file
/// What linear models of a machine have as inputs and outputs, by name.
#pragma once

#include "solvers/control/state_space.hpp"
#include "turbines/model/assembly.hpp"

#include <string>
#include <vector>

namespace cardan::turbines {

/// Of joints that are free "generator torque" (N m on the fast shaft, positive: brakes), "yaw moment", "blade 1 pitch
/// moment" ... (N m, positive toward feather); "thrust" (N, downwind along the shaft) and "rotor torque" (N m) on the
/// hub.
std::vector<solvers::LinearInput> linear_inputs(const Turbine& turbine, solvers::RotorSpin spin);

/// Channels: speeds, motions of the tower, loads and pitch angles, as far as the machine has them.
std::vector<std::string> linear_outputs(const Turbine& turbine);

/// Those that are named, in that order; no names: all.
/// @throws InputError for a name that there is not, with those that there are
std::vector<solvers::LinearInput> named_inputs(std::vector<solvers::LinearInput> all,
                                               const std::vector<std::string>& names);

}  // namespace cardan::turbines
