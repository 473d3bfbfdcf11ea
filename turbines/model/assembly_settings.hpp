/// @file
/// Settings of an assembly, as text for the description stored with every result.
#pragma once

#include "turbines/model/assembly.hpp"

namespace cardan::turbines {

/// "tower of 4 elements, mean differences, extension condensed, torsion free, blades of ..."
std::string settings(const TurbineDescription& description, const AssemblyOptions& options);

}  // namespace cardan::turbines
