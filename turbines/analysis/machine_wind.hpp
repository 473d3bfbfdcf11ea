/// @file
/// A machine's air, as settings have it, and the wind it stands in.
#pragma once

#include "turbines/aerodynamics/machine_air.hpp"
#include "turbines/analysis/settings.hpp"
#include "turbines/machine/machine.hpp"

#include <string>
#include <string_view>

namespace cardan::turbines {

/// The machine's, with what the settings change.
/// @throws InputError for a machine without airfoils
Aerodynamics air_of(const Machine& machine, const AirSettings& settings);

/// A steady wind without a speed, with the shear and the angles of the settings; its reference height is that of the
/// rotor's centre.
SteadyWind wind_profile(const Turbine& turbine, const Machine& machine, const AirSettings& settings, double density);

/// Steady or over time. Entries of a file that are not used are reported.
/// @param airfoil  for what the source does not say; that of a result is complete
/// @throws InputError for a result without wind; ParseError, FileError
Wind wind_of(const WindSource& source, const SteadyWind& airfoil, const Report& report = {});

/// The air's unsteadiness in words: "wake dynamic, airfoils unsteady".
/// @param wake  name_of(Wake), or "none"
std::string air_in_words(std::string_view wake, bool airfoils_unsteady);
/// The air of operating points and time histories in words: induced velocities, if there are any, and coefficients are
/// always in equilibrium with the motion.
std::string air_in_equilibrium(const Aerodynamics& air);
/// Settings of the air in words, for the description of a run.
std::string in_words(const AirSettings& settings);

}  // namespace cardan::turbines
