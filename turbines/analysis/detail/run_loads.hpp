/// @file
/// Generator and rotor torque of a run in time. Internal to the room.
#pragma once

#include "elements/controllers/torque_law.hpp"
#include "mbs/system/channel.hpp"
#include "turbines/analysis/settings.hpp"
#include "turbines/model/assembly.hpp"

#include <string>

namespace cardan::turbines {

/// Torque of the generator of a run without controller: T = torque + slope (speed - start), or a law, of the generator
/// on its own shaft.
struct GeneratorLoad {
    double torque = 0, slope = 0, start = 0, ratio = 1;  ///< N m, N m s/rad, rad/s, -
    BodyId shaft;
    TorqueLaw law = {};  ///< if it acts, in the place of torque and slope

    /// @param rate  of its coordinate
    TorqueLaw::At at(double rate) const {
        return law.acts() ? law.at(ratio * rate) : TorqueLaw::At{torque + slope * (ratio * rate - start), slope};
    }
    bool acts() const { return torque != 0 || slope != 0 || law.acts(); }
};
Turbine with_generator(const Turbine& turbine, const GeneratorLoad& generator);
/// "generator torque" (GenTq) and "generator power", mechanical.
ChannelGroup generator_channels(const GeneratorLoad& generator);

/// A follower load at the hub, about its z axis.
/// @throws InputError naming the row
FrameLoad load_of(const RotorTorque& torque, FrameId hub);
Turbine with_rotor_torque(const Turbine& turbine, const RotorTorque& torque);
/// A copy with the rotor torque of time zero for ever: for a start in the steady state.
Turbine with_first_rotor_torque(const Turbine& turbine, const RotorTorque& torque);
/// "rotor torque" and "rotor torque power".
ChannelGroup rotor_torque_channels(const RotorTorque& torque, FrameId hub);
/// Enough to tell another table.
std::string in_words(const RotorTorque& torque);

}  // namespace cardan::turbines
