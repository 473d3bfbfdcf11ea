/// @file
/// Options of the commands on air, wind and operation of a machine, and their translation to the library's settings.
#pragma once

#include "programs/shared/command_line.hpp"
#include "programs/shared/machine_file.hpp"
#include "solvers/campbell/diagram.hpp"
#include "turbines/analysis/machine_wind.hpp"
#include "turbines/analysis/wind_run.hpp"
#include "turbines/machine/machine.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cardan::program {

/// @name Air: airfoils, options, wind
///@{
struct AirArguments {
    std::string file;                  ///< AeroDyn's main file, or windIO; empty: the machine's
    double shear = 0;                  ///< exponent
    double direction = 0, upflow = 0;  ///< deg
    std::optional<double> density;
    bool no_skew = false, no_tower = false;
    std::string wake, airfoils;  ///< name_of(Wake), name_of(Airfoils); empty: as the machine says
};
/// Adds the file of the airfoils and the density alone.
/// @return the options
std::vector<Option> add_airfoil_options(CommandLine& app, AirArguments& arguments);
std::vector<Option> add_air_options(CommandLine& app, AirArguments& arguments);
/// Adds --airfoils to commands in still air.
Option add_airfoils_option(CommandLine& app, AirArguments& arguments);
/// Translates the arguments into the library's terms.
turbines::AirSettings settings_of(const AirArguments& arguments);

/// Puts the airfoils that were asked for in the place of the machine's, and prints the notes on those it has then.
/// @throws InputError for a machine without airfoils; as the readers
void take_air(turbines::Machine& machine, const AirArguments& arguments, MachineOptions& options);

inline constexpr const char* wind_class_format =
    "of IEC 61400-1: I, II, III or S with its reference speed, then A+, A, B or C (default: IA)";
/// The class of --wind-class; empty: the default.  @throws InputError naming the option
IecClass wind_class_of(const std::string& name);

inline constexpr const char* wind_file_format =
    "SPEED in m/s; or FILE: CSV with time[s],speed[m/s] and more, a turbulent wind (.bts, .wnd), InflowWind's main "
    "file, or a result (.h5) in the wind; or NAME of a wind of IEC 61400-1: nwp:12, eog:12, edc+:12, ecd-:12, "
    "ewsv+:12, ewsh-:12, ewm1, ewm50";
/// A speed, the path of a file that exists, or the name of a wind of IEC 61400-1.
/// @throws InputError for other words
turbines::WindSource wind_source(const std::string& given);
///@}

/// @name Commands with --wind over a range of speeds: what the wind is, how the machine runs in it
///@{
/// What the wind is, and how the machine runs in it.
struct WindArguments {
    std::string speeds;    ///< m/s, with ranges; empty: no wind
    std::string schedule;  ///< file; empty: the machine's, or variable speed
    AirArguments air;
    std::optional<double> tip_speed_ratio, rated_power, rated_rpm;  ///< kW
    double min_rpm = 0;

    bool sets_law() const;  ///< is there an option of variable speed?
};
/// @return --wind
Option add_wind_options(CommandLine& app, WindArguments& arguments);

/// m/s, rising; empty: no wind.  @throws InputError naming the option
std::vector<double> winds_of(const WindArguments& wind);
turbines::OperationSettings operation_of(const WindArguments& wind);

/// Arguments on the air's part in a vibration.
struct VibrationArguments {
    WindArguments wind;
    bool floquet = false;
    int harmonics = turbines::CampbellSettings().harmonics;
};
Option add_vibration_options(CommandLine& app, VibrationArguments& arguments);

/// @param rpm  --rpm; empty: it is not given
/// @throws InputError for a schedule beside options of variable speed, and for a rotor speed beside the wind
void check_wind(const WindArguments& wind, const std::string& rpm);

/// Reads the airfoils and the schedule that were asked for, which are the machine's from then on.
/// @throws InputError as take_air()
void take_wind(turbines::Machine& machine, const WindArguments& wind, MachineOptions& options);

/// For people: "wind speed 3 of 8". From the first one on, what is done is kept when a signal comes.
void show_progress(const char* what, int done, int total);
///@}

/// @name How a machine runs, as its source says or the options do: rotor speed, pitch
///@{
/// rad/s; none: it was not asked for.  @throws InputError for what is not finite
std::optional<double> asked_speed(const std::optional<double>& asked_rpm);

/// The rotor speed that was asked for, rev/min, or the machine's, which is reported.
/// @return rad/s;  @throws InputError if there is none
double rotor_speed(const std::optional<double>& asked_rpm, const turbines::Machine& machine);

/// Puts the machine's pitch at a rotor speed, rad/s, among options that have none, and reports it.
void set_pitch(const turbines::Machine& machine, MachineOptions& options, double rotor_speed);

/// --like
void add_like(CommandLine& app, std::string& file);

/// Title of a picture: the machine, and what the diagram holds for.
std::string title_of(const solvers::Campbell& diagram);

/// The name of the machine's file without its ending, and what was made of it: "NREL-5MW_campbell".
std::string default_prefix(const std::string& machine, const char* what);
///@}

}  // namespace cardan::program
