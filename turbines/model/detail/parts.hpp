/// @file
/// Data that a part of a machine needs of its description; not installed.
#pragma once

#include "turbines/model/assembly_options.hpp"
#include "turbines/model/description.hpp"

namespace cardan::turbines {

/// One blade on a rigid hub that spins about a fixed axis; it stays at its place.
/// @throws InputError for a blade that is missing
TurbineDescription blade_alone(const TurbineDescription& description, int number);
TurbineDescription tower_alone(const TurbineDescription& description);
/// The rest as far as it is given, on the ground: masses and records need no bearings.
TurbineDescription completed(TurbineDescription description);

/// Inertia of everything above the tower, undeformed, in axes of the tower top.
/// @param options  pitch, shaft beam
RigidInertia tower_top_inertia(TurbineDescription description, AssemblyOptions options);

}  // namespace cardan::turbines
