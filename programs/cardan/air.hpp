/// @file
/// Air on a machine, as programs are told of it: airfoils, options, wind.
#pragma once

#include "programs/shared/command_line.hpp"
#include "programs/shared/machine_file.hpp"
#include "turbines/analysis/machine_wind.hpp"
#include "turbines/machine/machine.hpp"

#include <optional>
#include <string>
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
/// Adds the options of the file of airfoils and of the density alone.
/// @return the options
std::vector<Option> add_airfoil_options(CommandLine& app, AirArguments& arguments);
std::vector<Option> add_air_options(CommandLine& app, AirArguments& arguments);
/// Adds the option of commands whose wake is in equilibrium, or none.
Option add_wake_option(CommandLine& app, AirArguments& arguments);
/// Arguments as settings of the library.
turbines::AirSettings settings_of(const AirArguments& arguments);

/// Puts the airfoils that were asked for in the place of the machine's, and prints the notes on those it has then.
/// @throws InputError for a machine without airfoils; as the readers
void take_air(turbines::Machine& machine, const AirArguments& arguments, MachineOptions& options);

inline constexpr const char* wind_file_format =
    "SPEED in m/s, or FILE: CSV with time[s],speed[m/s] and more, InflowWind's main file, or a result (.h5) in the "
    "wind";
/// A speed, or the path of a file that exists.
/// @throws InputError for other words
turbines::WindSource wind_source(const std::string& given);

}  // namespace cardan::program
