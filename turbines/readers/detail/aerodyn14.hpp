/// @file
/// Main file of AeroDyn 12 to 14, which FAST 7 and OpenFAST's predecessors had. Internal to the readers: not installed.
#pragma once

#include "turbines/readers/aerodyn.hpp"
#include "turbines/readers/openfast_file.hpp"

namespace cardan::turbines {

bool is_aerodyn14(const OpenFastFile& file);

/// Elements and polars: chord and twist of an element hold at its middle, those of the first and the last one to the
/// blade's ends. Taken as they are: induction and swirl, Prandtl's losses, pitching moments (UseCm). Noted: dynamic
/// stall, dynamic inflow, tower shadow, several tables in a polar (the first of each is used).
/// @param density, viscosity  where the file does not say
/// @throws ParseError, FileError
AeroDynFile read_aerodyn14(OpenFastFile& file, double density, double viscosity);

}  // namespace cardan::turbines
