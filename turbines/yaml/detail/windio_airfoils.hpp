/// @file
/// Airfoils of a windIO file. Internal to windio: not installed.
#pragma once

#include "elements/aerodynamics/polar.hpp"
#include "turbines/yaml/detail/windio_beams.hpp"

#include <string>
#include <vector>

namespace cardan::turbines {

/// Airfoil as a blade uses it.
struct WindioAirfoil {
    double thickness;  ///< over the chord
    double centre;     ///< aerodynamic centre, from the leading edge over the chord
    Polar polar;
};

/// Choice of the polars that a blade takes of an airfoil; all lists empty: those there are.
struct WindioPolarChoice {
    std::vector<std::string> configurations = {};
    std::vector<double> weights = {};  ///< one per configuration, with the sum 1
};

/// @param name  node that holds the name, for messages
/// @throws ParseError for an airfoil that does not exist, thickness or centre beyond 0 ... 1, polars that do not ascend
/// or do not reach around the circle
WindioAirfoil windio_airfoil(WindioFile& file, const YamlNode& name, const WindioPolarChoice& choice = {});

}  // namespace cardan::turbines
