/// @file
/// Driven coordinates that follow an input.
#pragma once

#include <string>

namespace cardan {

/// A driven coordinate that goes where an input u says: q -> factor (u - zero). It needs no inertia, no spring and no
/// state. How it gets there is left to what sets the input: solvers::SampledController.
struct InputDrive {
    int coordinate = -1;     ///< index in the model
    std::string input = {};  ///< name
    double factor = 1, zero = 0;
};

}  // namespace cardan
