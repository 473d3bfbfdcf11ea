/// @file
/// Aerodynamic data of the NREL 5 MW machine.
///
/// J. Jonkman, S. Butterfield, W. Musial, G. Scott, NREL/TP-500-38060, 2009: table 3-1 and the airfoil tables of the
/// public FAST and OpenFAST input files (turbines/data/nrel5mw_polars.csv, nrel5mw_aero_blade.csv).
#pragma once

#include "elements/aerodynamics/rigid_rotor.hpp"

namespace cardan::turbines {

/// 19 sections from the root (1.5 m) to the tip (63 m), eight profiles.
AeroBlade nrel5mw_aero_blade();

}  // namespace cardan::turbines
