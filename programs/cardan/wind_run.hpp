/// @file
/// A machine that is run over the wind speed: what `cardan steady` and `cardan campbell` have in common with --wind.
#pragma once

#include "turbines/operation/wind_operation.hpp"

#include "programs/cardan/air.hpp"
#include "programs/shared/machine_file.hpp"
#include <optional>
#include <string>
#include <vector>

namespace cardan::program {

/// What the wind is, and how the machine runs in it.
struct WindArguments {
    std::string speeds;    ///< m/s, with ranges; empty: no wind
    std::string schedule;  ///< file; empty: the machine's, or variable speed
    AirArguments air;
    std::optional<double> tip_speed_ratio, rated_power, rated_rpm;  ///< kW
    double least_rpm = 0;

    bool sets_law() const;  ///< is there an option of variable speed?
};

void add_wind_options(CommandLine& app, WindArguments& arguments);

/// The machine made ready, and its operating points.
struct WindRun {
    turbines::Aerodynamics air;
    std::vector<double> speeds;         ///< that were asked for, m/s
    std::optional<double> asked_pitch;  ///< by the options, deg
    ReadyMachine ready;
    turbines::WindOperationOptions in_wind;
    turbines::WindOperation operation;
    std::vector<turbines::WindPoint> points = {};  ///< that converged
    double remainder = 0;                          ///< WindPoint::remainder, the largest
    bool complete = false;                         ///< false: it was interrupted

    /// 130: interrupted, 1: some did not converge
    int exit_code() const;
};

/// Reads the airfoils and the schedule that were asked for, which are the machine's from then on.
/// @throws InputError for a schedule beside options of variable speed, and as take_air()
void take_wind(turbines::Machine& machine, const WindArguments& wind, bool all_notes);

/// Without points as yet.
/// @param machine  take_wind()
/// @param options  the pitch is set if it is not given
/// @param harmonics, azimuths  of a revolution: WindOperationOptions
/// @param max_frequency  up to which the mesh is to be accurate, Hz
WindRun wind_run(const turbines::Machine& machine, MachineOptions& options, const WindArguments& wind, int harmonics,
                 int azimuths, double max_frequency);

/// One operation by twice as many elements, of which deflections and twist of bent blades ask for more than frequencies
/// at rest do.
struct FinerPoint {
    turbines::WindOperation operation;
    turbines::WindPoint point;
};
FinerPoint finer_point(const WindRun& run, const turbines::Machine& machine, MachineOptions options,
                       const turbines::Operation& at);

/// One after the other, with progress. Those that do not converge are named on standard error.
void find_points(WindRun& run, const turbines::Machine& machine, const MachineOptions& options,
                 const WindArguments& wind);

}  // namespace cardan::program
