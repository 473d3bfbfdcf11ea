/// @file
/// Inputs and outputs of a machine's linear models, by name.
#pragma once

#include "solvers/linear_models/state_space.hpp"
#include "turbines/model/assembly.hpp"

#include <string>
#include <vector>

namespace cardan::turbines {

/// Inputs of a machine's linear models: of joints that are free "generator torque" (N m on the fast shaft, positive:
/// brakes), "yaw moment", "blade 1 pitch moment" ... (N m, positive toward feather); "thrust" (N, downwind along the
/// shaft) and "rotor torque" (N m) on the hub.
std::vector<solvers::LinearInput> linear_inputs(const Turbine& turbine, solvers::RotorSpin spin);

/// Channels: speeds, motions of the tower, loads and pitch angles, as far as the machine has them.
std::vector<std::string> linear_outputs(const Turbine& turbine);

/// Inputs of the given names, in that order; no names: all.
/// @throws InputError for a name that there is not, with those that there are
std::vector<solvers::LinearInput> named_inputs(std::vector<solvers::LinearInput> all,
                                               const std::vector<std::string>& names);

}  // namespace cardan::turbines
