/// @file
/// The element options of tower and blades that the options of an assembly amount to; not installed.
#pragma once

#include "turbines/model/assembly_options.hpp"
#include "turbines/model/description.hpp"

namespace cardan::turbines {

/// @throws InputError for numbers of elements that are given and not 1 ... 1000
void check_elements(const AssemblyOptions& options);

/// A number that is missing is 1: see seeks_blade_elements().
CardanBeamOptions tower_beam_options(const TowerDescription& tower, const AssemblyOptions& options);
CardanBeamOptions blade_beam_options(const BladeDescription& blade, const AssemblyOptions& options);
CardanBeamOptions shaft_beam_options(const AssemblyOptions& options);

/// Numbers of elements that are to be found.
bool seeks_blade_elements(const TurbineDescription& description, const AssemblyOptions& options);
bool seeks_tower_elements(const TurbineDescription& description, const AssemblyOptions& options);

}  // namespace cardan::turbines
