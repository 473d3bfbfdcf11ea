/// @file
/// Campbell diagram over the wind speed: the part of `cardan campbell` that has air.
#pragma once

#include "turbines/operation/aeroelastic.hpp"

#include "programs/cardan/wind_run.hpp"
#include <string>

namespace cardan::program {

/// What the air does to a vibration.
struct VibrationArguments {
    WindArguments wind;  ///< of its wake, air.wake, frozen and dynamic too
    bool steady_profiles = false, floquet = false;
    int harmonics = 4;

    VibrationArguments() { wind.air.wake = "dynamic"; }
};

void add_vibration_options(CommandLine& app, VibrationArguments& arguments);
/// As asked for, with the lags that the profiles have.
turbines::AeroelasticOptions air_that_lags(const VibrationArguments& arguments, const turbines::Aerodynamics& air);
/// air_in_words()
std::string vibration_in_words(const turbines::Aerodynamics& air, const turbines::AeroelasticOptions& options);

/// @param machine  take_wind()
/// @param prefix  of the files
/// @param air_roots  all computed, and drawn as well
/// @return exit code
int campbell_in_wind(const turbines::Machine& machine, MachineOptions& options, const VibrationArguments& air,
                     double max_frequency, const std::string& prefix, bool air_roots, const CommandLine& command);

}  // namespace cardan::program
