/// @file
/// Damping of the drive train's torsion by the generator of the 600 kW machine.
#pragma once

#include "examples/studies/wt600_electric/motion.hpp"

#include <string>

namespace cardan::electric {

struct DampingOptions {
    std::string speeds = "10,15,20,25,30,33";  ///< rpm
    double max_frequency = 8;                  ///< Hz
};

/// @return exit code
int damping(const MotionOptions& machine, const DampingOptions& options);

}  // namespace cardan::electric
