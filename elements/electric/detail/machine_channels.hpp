/// @file
/// Channels of electric machines.
#pragma once

#include "elements/electric/detail/induction_laws.hpp"
#include "mbs/system/channel.hpp"

#include <string>
#include <vector>

namespace cardan::detail {

/// Names of the channels of a machine whose currents are known.
std::vector<Channel> machine_channel_names(const std::string& name, const std::string& alias, bool fed_rotor);
/// Computes the values of the machine's channels.
void machine_channel_values(const MachineState<double>& at, double omega, double time, bool fed_rotor, double* values);

/// @param omega  of the axes in which the currents are given, rad/s
template <class Law>
ChannelGroup machine_channels(const std::string& name, const std::string& alias, const ForceElement& element, Law law,
                              const std::vector<ControlSignal>& demands, double omega, bool fed_rotor) {
    ChannelGroup group;
    group.channels = machine_channel_names(name, alias, fed_rotor);
    ForceElement seen{.name = element.name, .states = element.states, .coordinates = {element.coordinates.front()}};
    const auto functions = std::make_shared<const LawFunctions<Law>>(std::move(law), demands, seen);
    group.sample = [functions, element = element.name, omega, fed_rotor](const DynamicView& in, double* values) {
        const ElementValues own(in.forces.elements(), element, in);
        const auto x = functions->template values<double>(own.view());
        machine_channel_values(functions->law().state(functions->at(in.time, x)), omega, in.time, fed_rotor, values);
    };
    return group;
}

/// Channels of a machine that has nothing but a torque.
ChannelGroup torque_channels(const std::string& name, const std::string& alias, const ForceElement& element,
                             const MachineConstants& machine);

}  // namespace cardan::detail
