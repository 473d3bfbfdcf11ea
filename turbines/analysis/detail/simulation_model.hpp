/// @file
/// The model that a Simulation integrates. Internal to the room.
#pragma once

#include "solvers/time/integrate.hpp"
#include "turbines/analysis/prepared_machine.hpp"
#include "turbines/analysis/settings.hpp"

#include <string>
#include <vector>

namespace cardan::turbines {

/// A steady state to look for another one from: PeriodicOptions::start and state_start. Empty: undeformed.
struct StartGuess {
    Matrix q = {}, states = {};
    int azimuths = 0;  ///< SteadyRotationOptions::azimuths
};

/// The machine as it runs.
struct SimulationModel {
    Turbine turbine;
    Turbine at_start;  ///< `turbine` without anything that changes: springs in the place of actuators, a steady wind
    StartGuess guess = {};
    std::vector<solvers::SampledController> controllers = {};
    std::vector<ChannelGroup> channels = {};  ///< beside those of any machine
    std::string wind = {};                    ///< as text, for the file of the run
    std::function<void()> check_wind = {};    ///< throws FileError where the files of the wind have changed
};
/// @param machine  with_settings(), with its pitch drives
/// @param options  with rotor speed, pitch, wind and azimuth: take_run()
/// @param mesh     out
SimulationModel simulation_model(const Machine& machine, const SimulationSettings& options, Mesh& mesh,
                                 const Report& report);

/// Positions, rates and states at time zero.
struct SimulationState {
    Vector q, qd, s;
};
/// Steady, or undeformed, with a note, where there is no steady state.
SimulationState start_of(const SimulationModel& model, const SimulationSettings& options, const Report& report);

/// Settings of a run but its length, in words: start, controller, torque, wind.
std::string in_words(const SimulationSettings& options);
std::string_view name_of(solvers::Method method);

/// @throws InputError for fields out of range
void check(const SimulationSettings& options);

}  // namespace cardan::turbines
