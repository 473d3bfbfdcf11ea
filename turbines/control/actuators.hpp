/// @file
/// Pitch drives and the torque of the generator as actuators of a machine: what a controller acts upon, and signals of
/// what it measures.
///
///     turbines::give_pitch_springs(description);
///     const turbines::Turbine machine = turbines::assemble(description, options);
///     turbines::ActuatedForces actuated(machine);
///     const turbines::Turbine controlled = machine.with_forces(actuated.with_inputs(torque));
#pragma once

#include "elements/control/control_blocks.hpp"
#include "mbs/base/units.hpp"
#include "mbs/system/channel.hpp"
#include "turbines/model/assembly.hpp"

#include <string>
#include <vector>

namespace cardan::turbines {

/// Gives springs and dampers to pitch bearings that have none, rigid and free ones: as stiff as it takes for
/// `frequency` of the blade turning about its pitch axis as a rigid body. At 30 Hz, that of the pitch actuator in the
/// report of the NREL 5 MW machine, a blade of that size has some 10^9 N m/rad: its root turns by less than 0.01 deg
/// under the pitching moments of operation, and the modes of the blade are those of a rigid bearing.
/// @param frequency  rad/s;  @param damping  ratio of that mode
void give_pitch_springs(TurbineDescription& machine, double frequency = 2 * pi * 30, double damping = 0.1);

/// How the actuators follow their demands.
struct ActuatorOptions {
    /// Of the pitch actuators, of second order: rad/s. The default, 2 Hz, lags behind the speed loop of a large machine
    /// (0.6 rad/s) by 4 deg.
    double pitch_frequency = 4 * pi;
    double pitch_damping = 0.7;                     ///< ratio
    double largest_pitch_rate = 8 * units::degree;  ///< rad/s
    double torque_time_constant = 0.02;             ///< of the generator's torque, s
    double largest_torque_rate = 0;                 ///< N m/s; 0: no limit
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

/// Forces of a machine with actuators: between each blade and the actuator of its pitch are the spring and the damper
/// of the pitch bearing, which they replace. States: "blade 1 pitch actuator" (rad, absolute: it starts at the pitch
/// setting, where the bearing's spring is without load) with "blade 1 pitch actuator rate", and "torque actuator" (N
/// m).
class ActuatedForces {
public:
    /// @throws InputError for a machine without a generator, and for blades whose pitch bearings have no springs
    explicit ActuatedForces(const Turbine& turbine, ActuatorOptions options = {});

    /// With demands that are inputs: "torque demand" and "pitch demand", or individually "blade 1 pitch demand" ...;
    /// they start at `torque` and the pitch settings.
    /// @param torque  of the generator at the start, N m
    /// @param more    added to the torque demand, N m: a damper of the drive train
    ForceSet with_inputs(double torque, bool individual = false, const ControlSignal& more = signal::constant(0)) const;
    /// With any demands, e.g. those of variable_speed_equivalent(); its blocks are to be added.
    /// @throws InputError for a number of pitch demands that is neither 1 nor that of the blades
    ForceSet with_demands(const ActuatorDemands& demands, double torque) const;

    /// Names of these inputs: of the pitch, then that of the torque.
    std::vector<std::string> inputs(bool individual = false) const;
    /// What is recorded of them: the inputs and, if the actuator acts on the shaft, "generator torque" (GenTq),
    /// "generator power" (mechanical) and "electrical power" (GenPwr).
    /// @param efficiency  of the generator: electrical over mechanical power
    ChannelGroup channels(const System& system, bool individual, double efficiency = 1) const;

private:
    struct Spring {
        double stiffness, damping;
    };

    MachineLayout layout_;
    ActuatorOptions options_;
    ForceSet rest_;                ///< without the springs of the bearings
    std::vector<Spring> springs_;  ///< by blade
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
