/// @file
/// A controller on a machine in time: the options, what it measures, when it is called.
#pragma once

#include "elements/control/bladed_controller.hpp"
#include "solvers/time/sampled.hpp"
#include "turbines/control/actuators.hpp"

#include "programs/shared/machine_file.hpp"
#include <string>
#include <vector>

namespace cardan::program {

struct ControllerOptions {
    std::string what;           ///< "baseline", or the path of a shared library; empty: none
    std::string input;          ///< file for the library
    double period = 0.0125;     ///< s
    double efficiency = 1;      ///< of the generator
    std::string pitch_control;  ///< of a library: collective or individual; empty: as the model says
    /// HZ[:DAMPING[:DEG/S]] of actuators of the pitch; empty: the pitch is prescribed, or as the model's springs have
    /// it
    std::string pitch_actuator;

    bool acts() const { return !what.empty(); }
    bool is_baseline() const { return what == "baseline"; }
    bool is_individual() const { return pitch_control == "individual"; }
};

/// --controller, --controller-input, --controller-period, --generator-efficiency, --pitch-actuator, --pitch-control.
void add_controller_options(CommandLine& app, ControllerOptions& options);

/// Puts what the model says of the pitch where the options say nothing.
/// @throws InputError for a period or an efficiency out of range, an input without a controller that reads it, a rotor
/// that is driven, and the baseline controller on a machine that is another one than the NREL 5 MW machine
void check_controller(ControllerOptions& options, const turbines::Machine& machine);

/// Makes the pitch bearings of a machine that is to be controlled: blades without a spring of their own are prescribed,
/// or get one for the actuator that is asked for.
/// @throws InputError for a linkage, and for an actuator of blades without inertia about their pitch axes
void make_pitch_drives(const ControllerOptions& options, turbines::TurbineDescription& machine);
/// @throws InputError for what is no actuator
turbines::ActuatorOptions actuator_options(const ControllerOptions& options);

/// Torque of the generator at which the controller begins, N m: of the baseline controller its own at that speed and
/// pitch, else that which balances the rotor's.
/// @param speed         of the rotor, rad/s;  @param pitch  rad
/// @param rotor_torque  at the start, N m
double start_torque(const ControllerOptions& options, double ratio, double speed, double pitch, double rotor_torque);

/// A machine under a controller.
struct ControlledMachine {
    turbines::Turbine turbine;  ///< with actuators, whose demands are inputs: of each blade alone by a library
    solvers::SampledController controller;
    ChannelGroup channels;  ///< of ActuatedForces
    std::string pitch;      ///< how the blades follow, in a line
};
/// @param machine  whose pitch is prescribed or on springs: turbines::give_pitch_drives(), give_pitch_springs()
/// @param torque   of the generator at the start, N m
/// @param prefix   of files that a library writes
/// @param also     channels that a library measures beside those of any machine
/// A library turns the nacelle where its yaw is prescribed. What it says, and what of its demands the machine cannot
/// obey, is printed once.
/// @param more     added to the demanded torque, N m
/// @param actuators  how demands are followed
/// @throws FileError for a library that cannot be loaded or has no function DISCON
ControlledMachine controlled_machine(const ControllerOptions& options, const turbines::Turbine& machine, double torque,
                                     const std::string& prefix, const std::vector<ChannelGroup>& also = {},
                                     const ControlSignal& more = signal::constant(0),
                                     const turbines::ActuatorOptions& actuators = {});

/// For the file of a run.
std::string in_words(const ControllerOptions& options);

}  // namespace cardan::program
