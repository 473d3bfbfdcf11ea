/// @file
/// Numbers of elements for parts by themselves; not installed.
#pragma once

#include "turbines/model/mesh.hpp"

namespace cardan::turbines {

/// Converged mesh of one clamped blade, as converged_mesh().
/// @param description  of which only the blade is looked at
Mesh blade_mesh(const TurbineDescription& description, const AssemblyOptions& options, int number);
/// Converged mesh of the tower.
/// @param with_top  with everything above it as one rigid body
Mesh tower_mesh(const TurbineDescription& description, const AssemblyOptions& options, bool with_top);

}  // namespace cardan::turbines
