/// @file Options of commands with --wind over a range of speeds, and their meaning to the library.
#pragma once

#include "programs/cardan/air.hpp"
#include "programs/shared/machine_file.hpp"
#include "turbines/analysis/wind_run.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cardan::program {

/// Arguments of the wind and of the machine's operation in it.
struct WindArguments {
    std::string speeds;    ///< m/s, with ranges; empty: no wind
    std::string schedule;  ///< file; empty: the machine's, or variable speed
    AirArguments air;
    std::optional<double> tip_speed_ratio, rated_power, rated_rpm;  ///< kW
    double least_rpm = 0;

    bool sets_law() const;  ///< is there an option of variable speed?
};
/// @return --wind
Option add_wind_options(CommandLine& app, WindArguments& arguments);

/// m/s, rising; empty: no wind.  @throws InputError naming the option
std::vector<double> winds_of(const WindArguments& wind);
turbines::OperationSettings operation_of(const WindArguments& wind);

/// Arguments of what the air does to a vibration.
struct VibrationArguments {
    WindArguments wind;  ///< of its wake, air.wake, frozen and dynamic too
    bool steady_airfoils = false, floquet = false;
    int harmonics = turbines::CampbellSettings().harmonics;

    VibrationArguments() { wind.air.wake = "dynamic"; }
};
Option add_vibration_options(CommandLine& app, VibrationArguments& arguments);
turbines::VibrationSettings vibration_of(const VibrationArguments& arguments);

/// @param rpm  --rpm; empty: it is not given
/// @throws InputError for a schedule beside options of variable speed, and for a rotor speed beside the wind
void check_wind(const WindArguments& wind, const std::string& rpm);

/// Reads the airfoils and the schedule that were asked for, which are the machine's from then on.
/// @throws InputError as take_air()
void take_wind(turbines::Machine& machine, const WindArguments& wind, MachineOptions& options);

/// Shows progress to people: "wind speed 3 of 8". From the first one on, what is done is kept when a signal comes.
void show_progress(const char* what, int done, int total);
}  // namespace cardan::program
