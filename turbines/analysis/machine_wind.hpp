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

/// The place of a wind: what a machine and its settings say of it where the source does not.
struct WindSite {
    SteadyWind profile = {};    ///< wind_profile()
    double rotor_diameter = 0;  ///< m, for gusts
    AirSettings air = {};
};
WindSite wind_site(const Turbine& turbine, const Machine& machine, const AirSettings& settings, double density);

/// The wind of a source, whatever kind it is of. Entries of a file that are not used are reported.
/// @throws InputError for a result without wind, and for a shear where the wind has its own; ParseError, FileError
Wind wind_of(const WindSource& source, const WindSite& site, const Report& report = {});
/// Speed of the wind at the hub that a run starts in, m/s.  @throws InputError, ParseError, FileError
double start_speed(const WindSource& source, const AirSettings& settings);

/// The air's unsteadiness in words: "wake dynamic, airfoils unsteady".
/// @param wake  name_of(Wake), or "none"
std::string air_in_words(std::string_view wake, bool airfoils_unsteady);
/// The air of operating points and time histories in words: induced velocities, if there are any, and coefficients are
/// always in equilibrium with the motion.
std::string air_in_equilibrium(const Aerodynamics& air);
/// Settings of the air in words, for the description of a run.
std::string in_words(const AirSettings& settings);

}  // namespace cardan::turbines
