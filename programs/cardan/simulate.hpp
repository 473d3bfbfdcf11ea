/// @file
/// What `cardan simulate` simulates: the machine with its generator or controller, in the air or driven by a torque.
#pragma once

#include "programs/cardan/air.hpp"
#include "programs/shared/channel_choice.hpp"
#include "programs/shared/controller.hpp"
#include "programs/shared/rotor_torque.hpp"
#include "programs/shared/simulation_run.hpp"
#include <optional>
#include <string>
#include <vector>

namespace cardan::program {

struct SimulateArguments {
    MachineOptions machine;
    RunArguments run;
    StationOptions stations;
    ControllerOptions controller;
    AirArguments air;
    std::optional<double> rpm, torque;
    std::string start = "steady", rotor_torque, wind;
    double azimuth = 0, slope = 0;
    bool no_gravity = false, list = false;
    std::vector<std::string> plot, q, qd;
};

/// Out of balance by less, in rad or m, a steady state is good enough to start from.
inline constexpr double good_start = 1e-6;

/// The machine as it runs here.
struct Subject {
    turbines::Turbine turbine;
    turbines::Turbine at_start;  // the same without anything that changes: springs in the place of actuators
    std::vector<solvers::SampledController> controllers;
    std::vector<ChannelGroup> channels;  // beside those of any machine
    double speed;                        // rad/s, at the start
    bool driven;
    std::string title, about;  // for the file: without the command, which differs if a run goes on
};
/// With what the options leave open filled in.
Subject subject_of(SimulateArguments& arguments);

}  // namespace cardan::program
