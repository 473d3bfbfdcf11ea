/// @file
/// Aerodynamic sections on the rigid segments of a blade. Internal to the air on machines: not installed.
#pragma once

#include "elements/aerodynamics/rigid_rotor.hpp"
#include "turbines/aerodynamics/detail/air_line.hpp"
#include "turbines/model/assembly.hpp"

#include <vector>

namespace cardan::turbines {

/// A section where the air is evaluated, carried by a rigid segment; axes of the segment's body.
struct AirSection {
    int body;
    Vec3 place;       ///< aerodynamic centre, m
    Vec3 span;        ///< along the blade to its tip, unit
    Vec3 chord;       ///< from leading to trailing edge, unit
    Annulus annulus;  ///< without the angle and the radius, which the motion gives
};

struct AirBlade {
    std::vector<AirSection> sections;  ///< from root to tip
    std::vector<AirPoint> points;      ///< by body, descending
    Vec3 axis;                         ///< of the pitch, to the tip, axes of the hub's body
    std::vector<int> path;             ///< bodies from the base to the tip, ascending
};

/// @param k  of the machine's blades, from 0
/// @throws InputError for sections beyond the ends of the blade
AirBlade air_blade(const Turbine& turbine, std::size_t k, const AeroBlade& blade);

}  // namespace cardan::turbines
