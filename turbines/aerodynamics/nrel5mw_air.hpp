/// @file
/// Aerodynamic data of the NREL 5 MW machine.
///
/// J. Jonkman, S. Butterfield, W. Musial, G. Scott, NREL/TP-500-38060, 2009: table 3-1 and the airfoil tables of the
/// public FAST and OpenFAST input files (turbines/data/nrel5mw_polars.csv, nrel5mw_aero_blade.csv).
#pragma once

#include "elements/aerodynamics/rigid_rotor.hpp"
#include "elements/aerodynamics/unsteady_airfoil.hpp"

#include <cstdint>
#include <vector>

namespace cardan::turbines {

/// Source of the aerodynamic centres of the sections.
enum class Nrel5mwCentres : std::uint8_t {
    pitch_axis,  ///< as in the public files of AeroDyn 15
    report       ///< as the report's table of the blade says: up to an eighth of the chord before the pitch axis, about
                 ///< which the blade twists
};

/// 19 sections from the root (1.5 m) to the tip (63 m), eight airfoils.
AeroBlade nrel5mw_aero_blade(Nrel5mwCentres centres = Nrel5mwCentres::pitch_axis);

/// Airfoils of the machine with the lags of their flow; the two cylinders have none. Angles without lift and of
/// separation from the public files; that of the NACA64 airfoil is the zero of its table
/// (turbines/data/nrel5mw_unsteady.csv).
std::vector<UnsteadyAirfoil> nrel5mw_unsteady_airfoils();

}  // namespace cardan::turbines
