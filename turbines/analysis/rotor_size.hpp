/// @file
/// Place and size of the rotor of a machine in the wind.
#pragma once

#include "turbines/machine/machine.hpp"

namespace cardan::turbines {

/// A rotor in the wind is a circle at a height.
struct RotorSize {
    double hub_height = 0;  ///< of the rotor's centre above the ground or the still water, m
    double diameter = 0;    ///< twice the hub's radius and a blade's length along its axis, m
};
/// The rotor of a machine at rest, as its winds count heights (wind_site()).
/// @throws InputError for a machine without blades, and as assemble()
RotorSize rotor_size(const Machine& machine);

}  // namespace cardan::turbines
