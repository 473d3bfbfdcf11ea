/// @file
/// How a description is assembled, as text for the description stored with every result.
#pragma once

#include "turbines/model/assembly.hpp"

namespace cardan::turbines {

/// "3 tower elements, 3 elements per blade, ..."
std::string settings(const TurbineDescription& description, const AssemblyOptions& options);

}  // namespace cardan::turbines
