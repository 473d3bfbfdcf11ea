/// @file
/// Options of `cardan simulate`, and what they mean to the library.
#pragma once

#include "programs/cardan/options.hpp"
#include "programs/shared/channel_choice.hpp"
#include "programs/shared/machine_file.hpp"
#include "programs/shared/simulation_run.hpp"
#include "turbines/analysis/simulation.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cardan::program {

/// Arguments of a controller.
struct ControllerArguments {
    std::string what;   ///< "baseline", "none", or the path of a shared library; empty: the model's
    std::string input;  ///< file for the library
    std::optional<double> period, efficiency;
    std::string pitch_control;   ///< of a library: collective or individual; empty: as the model says
    std::string pitch_actuator;  ///< HZ[:DAMPING[:DEG/S]]; empty: none
};

/// Arguments of winds that change with time.
struct InflowArguments {
    std::string outside = "refuse";  ///< of a box
    std::string wind_class;          ///< of IEC 61400-1; empty: I A
    double gust_start = turbines::AirSettings().gust_start;
};

struct SimulateArguments {
    MachineOptions machine;
    RunArguments run;
    StationOptions stations;
    ControllerArguments controller;
    AirArguments air;
    InflowArguments inflow;
    std::optional<double> rpm, torque, azimuth, duration, rated_power;
    std::string start = "steady", rotor_torque, wind;
    double slope = 0;
    bool no_gravity = false, list = false;
    std::vector<std::string> plot, q, qd;
};

void declare(CommandLine& app, SimulateArguments& arguments);

/// @throws InputError naming the option, FileError, ParseError
turbines::SimulationSettings settings_of(const SimulateArguments& arguments);
/// Puts what the library has taken where nothing was given.
void keep_taken(const turbines::SimulationSettings& taken, SimulateArguments& arguments);

}  // namespace cardan::program
