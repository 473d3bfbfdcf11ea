/// @file
/// Air on a machine, as programs are told of it: profiles, options, wind.
#pragma once

#include "elements/aerodynamics/wind.hpp"
#include "turbines/machine/machine.hpp"

#include "programs/shared/command_line.hpp"
#include <optional>
#include <string>
#include <string_view>

namespace cardan::program {

struct AirArguments {
    std::string file;                  ///< AeroDyn's main file, or windIO; empty: the machine's
    double shear = 0;                  ///< exponent
    double direction = 0, upflow = 0;  ///< deg
    std::optional<double> density;
    bool no_skew = false, no_tower = false;
    std::string wake = "quasi-steady";  ///< "none": no induced velocities
};
/// Of these, file and density alone.
void add_profile_options(CommandLine& app, AirArguments& arguments);
void add_air_options(CommandLine& app, AirArguments& arguments);
/// Of commands whose wake is in equilibrium, or none.
void add_wake_option(CommandLine& app, AirArguments& arguments);
/// For the file of a run.
std::string in_words(const AirArguments& arguments);

/// Puts the airfoils that were asked for in the place of the machine's, and prints the notes on those it has then.
/// @throws InputError for a machine without airfoils; as the readers
void take_air(turbines::Machine& machine, const AirArguments& arguments, bool all_notes);
/// The machine's, as the other options have it.
turbines::Aerodynamics air_of(const turbines::Machine& machine, const AirArguments& arguments);

/// How the air follows a motion, for titles and files: "wake dynamic, profiles unsteady".
/// @param wake  turbines::name_of(), or "none"
std::string air_in_words(std::string_view wake, bool profiles_lag);
/// Of operating points and time histories: induced velocities, if there are any, and coefficients are always in
/// equilibrium with the motion.
std::string air_in_equilibrium(const turbines::Aerodynamics& air);
/// The line that every command with air prints of it: "air of the vibrations: wake dynamic, profiles unsteady".
/// @param what  the air is of
void tell_air(const char* what, const std::string& words);

/// As the options say, without a speed; its reference height is that of the rotor's centre.
SteadyWind wind_profile(const AirArguments& arguments, double density, const turbines::Machine& machine,
                        const turbines::Turbine& turbine);

inline constexpr const char* wind_file_format =
    "SPEED in m/s, or FILE: CSV with time[s],speed[m/s] and more, InflowWind's main file, or a result (.h5) in the "
    "wind";
/// A steady wind, or one over time.
/// @param profile  for what the file does not say; that of a result is complete
/// @throws InputError, ParseError, FileError
Wind wind_of(const std::string& given, const SteadyWind& profile, bool all_notes);

}  // namespace cardan::program
