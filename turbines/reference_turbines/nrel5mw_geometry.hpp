/// @file
/// Positions of the parts of the NREL 5 MW machine: turbines/data/nrel5mw_turbine.csv.
#pragma once

namespace cardan::turbines {

/// Dimensions in m and rad, with the sign conventions of this library.
struct Nrel5mwGeometry {
    double tower_height;
    double shaft_above_tower;  ///< where the shaft axis meets the tower axis, above the tower top
    double overhang;           ///< from the tower axis to the rotor centre along the shaft, upwind
    double tilt;               ///< upwind end of the shaft up
    double cone;               ///< tips downwind positive
    double hub_radius;
    double rated_speed;  ///< of the rotor, rad/s
};

/// The data, read once.
const Nrel5mwGeometry& nrel5mw_geometry();

}  // namespace cardan::turbines
