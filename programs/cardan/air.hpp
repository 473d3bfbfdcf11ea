/// @file
/// Air on a machine, as programs are told of it: profiles, options, wind.
#pragma once

#include "elements/aerodynamics/rigid_rotor.hpp"
#include "elements/aerodynamics/tower.hpp"
#include "elements/aerodynamics/unsteady_profile.hpp"
#include "elements/aerodynamics/wind.hpp"

#include "programs/shared/command_line.hpp"
#include "programs/shared/machine_file.hpp"
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// Profiles and options of the air.
struct Air {
    AeroBlade blade;
    RotorAirOptions options;
    double density = 1.225;
    AeroSupport support = {};  ///< heights as the file has them
    /// Of the blade's polars, with their lags; empty: they have no such data.
    std::vector<UnsteadyProfile> profiles = {};
};
/// @throws InputError for a machine without profiles; as the readers
Air air_of(const MachineFile& machine, const MachineOptions& options, const AirArguments& arguments);

/// How the air follows a motion, for titles and files: "wake dynamic, profiles unsteady".
/// @param wake  turbines::name_of(), or "none"
std::string air_in_words(std::string_view wake, bool profiles_lag);
/// Of operating points and time histories: induced velocities, if there are any, and coefficients are always in
/// equilibrium with the motion.
std::string air_in_equilibrium(const Air& air);
/// The line that every command with air prints of it: "air of the vibrations: wake dynamic, profiles unsteady".
/// @param what  the air is of
void tell_air(const char* what, const std::string& words);

/// Tower and nacelle, the foot of the tower where the machine's file says, or else the machine, that it stands.
AeroSupport support_of(const Air& air, const MachineFile& machine, const turbines::Turbine& turbine);

/// As the options say, without a speed; its reference height is that of the rotor's centre.
SteadyWind wind_profile(const AirArguments& arguments, const Air& air, const MachineFile& machine,
                        const turbines::Turbine& turbine);

inline constexpr const char* wind_file_format =
    "SPEED in m/s, or FILE: CSV with time[s],speed[m/s] and more, or InflowWind's main file";
/// A steady wind, or one over time.
/// @param profile  for what the file does not say
/// @throws InputError, ParseError, FileError
Wind wind_of(const std::string& given, const SteadyWind& profile, bool all_notes);

}  // namespace cardan::program
