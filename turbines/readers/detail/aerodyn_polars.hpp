/// @file
/// Airfoils from AeroDyn's files of polars: their tables, and how their flow lags.
#pragma once

#include "elements/aerodynamics/unsteady_airfoil.hpp"
#include "turbines/readers/detail/polar_rows.hpp"

#include <filesystem>
#include <vector>

namespace cardan::turbines {

/// A polar and, from its first table, what AeroDyn's four states (UA_Mod 4) and Oye's one (6) need: C_lalpha, alpha0,
/// alphaUpper, alphaLower, Cd0, A1, A2, b1, b2, T_p, T_f0. What is missing, or "default", is found as AeroDyn does
/// (attached_flow(), UnsteadyAirfoilConstants). The flow begins to separate at alphaUpper and alphaLower; without them
/// at the ends of the range found, or at alpha1 and alpha2 (f = 0.7) where these lie beyond.
/// @param model  of the lags
/// @param all    tables, not the first one alone
/// @param notes  is added to: what is different here
/// @throws ParseError, FileError
UnsteadyAirfoil read_aerodyn_airfoil(const std::filesystem::path& path, const PolarColumns& columns, bool all,
                                     UnsteadyAirfoilModel model, std::vector<FileNote>& notes);

}  // namespace cardan::turbines
