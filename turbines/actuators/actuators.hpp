/// @file
/// Pitch drives and the torque of the generator as actuators of a machine: what a controller acts upon, and signals of
/// what it measures.
///
/// The pitch of a blade is prescribed, as in OpenFAST, unless the model gives its bearing a spring or actuators are
/// asked for:
///
///     turbines::give_pitch_drives(description);
///     const turbines::Turbine machine = turbines::assemble(description, options);
///     turbines::ActuatedForces actuated(machine);
///     const turbines::Turbine controlled = machine.with_forces(actuated.with_inputs(torque));
///     controller.inputs = actuated.inputs();
///     controller.drives = actuated.drives();
#pragma once

#include "elements/controllers/control_blocks.hpp"
#include "mbs/base/units.hpp"
#include "mbs/system/channel.hpp"
#include "mbs/system/input_drive.hpp"
#include "turbines/model/assembly.hpp"

#include <string>
#include <vector>

namespace cardan::turbines {

/// Prescribes the pitch of blades whose bearings have no springs, rigid and free ones: what turns them is as strong as
/// it takes, and they need no inertia about their axes.
/// @throws InputError for a blade that a linkage turns
void give_pitch_drives(TurbineDescription& machine);

/// Gives springs and dampers to pitch bearings that have none, rigid and free ones: as stiff as it takes for
/// `frequency` of the blade turning about its pitch axis as a rigid body. At 30 Hz, that of the pitch actuator in the
/// report of the NREL 5 MW machine, a blade of that size has some 10^9 N m/rad: its root turns by less than 0.01 deg
/// under the pitching moments of operation, and the modes of the blade are those of a rigid bearing.
/// @throws InputError for blades without inertia about their pitch axes
/// @param frequency  rad/s;  @param damping  ratio of that mode
void give_pitch_springs(TurbineDescription& machine, double frequency = 2 * pi * 30, double damping = 0.1);

/// Options of how the actuators follow their demands.
struct ActuatorOptions {
    /// Natural frequency of the pitch actuators, of second order and in series with the springs of the bearings: rad/s.
    /// At 2 Hz one lags behind the speed loop of a large machine (0.6 rad/s) by 4 deg. 0: there are none.
    double pitch_frequency = 0;
    double pitch_damping = 0.7;          ///< ratio
    double max_pitch_rate = 0;           ///< of the actuators, rad/s; 0: no limit
    double torque_time_constant = 0.02;  ///< of the generator's torque, s
    double max_torque_rate = 0;          ///< N m/s; 0: no limit
    /// false: the torque actuator acts on nothing; another element has its state as demand,
    /// signal::state(torque_state), and acts on the shaft itself: a machine with its converter. Its channels are those
    /// of the torque then.
    bool torque_on_shaft = true;
};

/// Demands, for the generator positive where it brakes, for the pitch positive towards feather.
struct ActuatorDemands {
    std::vector<ControlSignal> pitch;  ///< one for all blades, or one for each of them, rad
    ControlSignal torque;              ///< N m, on the generator's own shaft
};

/// Forces of a machine with actuators. How a blade follows its demand:
///
/// * Its pitch is prescribed (give_pitch_drives(), JointSupport::Kind::prescribed): it goes as
/// solvers::SampledController says,
///   within two periods. The torque that it takes is that of the coordinate's drive.
/// * Its bearing has a spring, which rests at the demand: the moment towards feather is stiffness (demand - pitch) -
///   damping d(pitch)/dt, as of BeamDyn's pitch actuator.
/// * It has an actuator (ActuatorOptions::pitch_frequency): between that and the blade are spring and damper of the
///   bearing. States: "blade 1 pitch actuator" (rad, absolute: it starts at the pitch setting, where the bearing's
///   spring is without load) with "blade 1 pitch actuator rate".
///
/// The torque is a state, "torque actuator" (N m).
class ActuatedForces {
public:
    /// @throws InputError for a machine without a generator, for blades whose pitch is neither prescribed nor held by a
    /// spring, and for actuators of a pitch that is prescribed
    explicit ActuatedForces(const Turbine& turbine, ActuatorOptions options = {});

    /// Forces with actuators whose demands are inputs: "torque demand" and "pitch demand", or individually "blade 1
    /// pitch demand" ...; they start at `torque` and the pitch settings.
    /// @param torque  of the generator at the start, N m
    /// @param more    added to the torque demand, N m: a damper of the drive train
    ForceSet with_inputs(double torque, bool individual = false, const ControlSignal& more = signal::constant(0)) const;
    /// Forces with actuators of any demands, e.g. those of variable_speed_equivalent(); its blocks are to be added.
    /// @throws InputError for a number of pitch demands that is neither 1 nor that of the blades, and for a pitch that
    /// is prescribed, which only a sampled controller can set
    ForceSet with_demands(const ActuatorDemands& demands, double torque) const;

    /// Names of these inputs: of the pitch, then that of the torque.
    std::vector<std::string> inputs(bool individual = false) const;
    /// Prescribed motions of the blades whose pitch is prescribed: SampledController::drives.
    std::vector<InputDrive> drives(bool individual = false) const;
    /// The blades' actuators in a line: "pitch prescribed ...", "blade 1: ..., blade 2: ..." if they differ.
    std::string in_words() const;
    /// Channels of the actuators: the inputs and, if the actuator acts on the shaft, "generator torque" (GenTq),
    /// "generator power" (mechanical) and "electrical power" (GenPwr).
    /// @param efficiency  of the generator: electrical over mechanical power
    ChannelGroup channels(const System& system, bool individual, double efficiency = 1) const;

private:
    struct PitchBearing {
        int coordinate = -1;  ///< in the model
        bool prescribed = false;
        double stiffness = 0, damping = 0;
    };
    void add_pitch(ForceSet& forces, std::size_t k, const ControlSignal& demand) const;
    ForceSet with_any(const ActuatorDemands& demands, double torque) const;
    std::string in_words(const PitchBearing& bearing) const;

    MachineLayout layout_;
    ActuatorOptions options_;
    ForceSet rest_;                       ///< without the springs that actuators replace
    std::vector<PitchBearing> bearings_;  ///< by blade
};

/// Speed of the generator on its own shaft, rad/s.
ControlSignal generator_speed(const MachineLayout& layout);
/// Mean pitch of the blades, positive towards feather, rad.
/// @throws InputError for a machine without pitch joints
ControlSignal mean_pitch(const MachineLayout& layout);

/// Name of the state of the generator's torque.
inline constexpr const char* torque_state = "torque actuator";
/// "blade 1 pitch actuator"
std::string pitch_state(int blade);

}  // namespace cardan::turbines
