/// @file
/// The options of an assembly in words, for the description that is kept with every result.
#pragma once

#include "turbines/model/assembly.hpp"

namespace cardan::turbines {

/// "3 tower elements, 3 elements per blade, ..."
std::string settings(const AssemblyOptions& options);

}  // namespace cardan::turbines
