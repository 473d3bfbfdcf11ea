/// @file
/// A machine under a controller in time: what it measures, when it is called, what it acts upon.
#pragma once

#include "elements/controllers/control_signal.hpp"
#include "solvers/time/sampled.hpp"
#include "turbines/analysis/settings.hpp"
#include "turbines/machine/machine.hpp"

#include <string>
#include <vector>

namespace cardan::turbines {

/// A controller with the machine's values where it has none: kind, period, efficiency, individual pitch, numbers of the
/// baseline controller. What was taken is reported.
/// @throws InputError for a period or an efficiency out of range, a file that nobody reads, an actuator without a
/// controller, a rotor that does not turn freely, and as baseline_controller(); FileError for an input that does not
/// exist
Controller checked(Controller controller, const Machine& machine, const Report& report = {});

/// Makes the pitch bearings of a machine that is to be controlled: blades without a spring of their own are prescribed,
/// or get one for actuators that are asked for.
/// @throws InputError for a linkage, and for an actuator of blades without inertia about their pitch axes
void make_pitch_drives(const Controller& controller, TurbineDescription& machine);

/// State in which a controller begins.
struct ControllerStart {
    double speed = 0;         ///< of the rotor, rad/s
    double pitch = 0;         ///< rad
    double rotor_torque = 0;  ///< N m
};
/// Torque of the generator at the start, N m: of the baseline controller its own at that speed and pitch, else that
/// which balances the rotor's.
double start_torque(const Controller& controller, double gear_ratio, const ControllerStart& start);

struct ControlledMachineOptions {
    double torque = 0;                                ///< of the generator at the start, N m
    std::vector<ChannelGroup> also_measured = {};     ///< that a library measures beside those of any machine
    ControlSignal more_torque = signal::constant(0);  ///< added to the demanded torque, N m
    Report report = {};  ///< of what a library says, and of its demands that the machine cannot obey, each once
};

struct ControlledMachine {
    Turbine turbine;  ///< with actuators, whose demands are inputs: of each blade alone by a library
    solvers::SampledController controller;
    ChannelGroup channels;  ///< of ActuatedForces
    std::string pitch;      ///< how the blades follow, in a line
};
/// A library turns the nacelle where its yaw is prescribed.
/// @param own      with all that it has to say: checked()
/// @param machine  whose pitch is prescribed or on springs: make_pitch_drives()
/// @throws FileError for a library that cannot be loaded or has no function DISCON
ControlledMachine controlled_machine(const Controller& own, const Turbine& machine,
                                     const ControlledMachineOptions& options);

/// A controller in words, for the description of a run; empty: there is none.
std::string in_words(const Controller& controller);

}  // namespace cardan::turbines
