/// @file
/// A machine's air, as settings have it, and the wind it stands in.
#pragma once

#include "turbines/aerodynamics/machine_air.hpp"
#include "turbines/analysis/settings.hpp"
#include "turbines/machine/machine.hpp"

#include <string>

namespace cardan::turbines {

/// The machine's, with what the settings change: the models that hold, and unsteady airfoils only where they do.
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
/// A wind that changes with time in words, with the seed and the checksum of a box; empty: it is steady.
std::string in_words(const Wind& wind);
/// Speed of the wind at the hub that a run starts in, m/s.  @throws InputError, ParseError, FileError
double start_speed(const WindSource& source, const AirSettings& settings);

/// "wake oye, airfoils unsteady", with what says so.
std::string in_words(const AirModel& model);
/// The air of operating points in words: induced velocities and coefficients do not lag there.
std::string air_in_equilibrium(const Aerodynamics& air);
/// Settings of the air in words, for the description of a run.
std::string in_words(const AirSettings& settings);

}  // namespace cardan::turbines
