/// @file
/// Tubes, as towers are.
#pragma once

#include "elements/sections/beam_line.hpp"

namespace cardan {

/// A straight tube of linear taper: outer diameter from base to top, wall thickness constant in each of the equal
/// conical sections; exact annulus, shear stiffness k G A, sectional inertia rho I.
struct TubeSpec {
    double length = 0, diameter_base = 0, diameter_top = 0;  ///< m
    std::vector<double> wall_thickness = {};                 ///< m, one per conical section from the base up
    double E = 0, G = 0, density = 0;                        ///< Pa, Pa, kg/m^3
    double shear_factor = 0.5;                               ///< k
};
BeamLine tube(const TubeSpec& spec, std::string name = "tube");

}  // namespace cardan
