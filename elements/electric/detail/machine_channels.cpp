#include "elements/electric/detail/machine_channels.hpp"

#include <cmath>

namespace cardan::detail {

namespace {

Channel torque_channel(const std::string& name, const std::string& alias) {
    return {.name = name + " torque",
            .units = "N m",
            .long_name = "electromagnetic torque of the generator on its own shaft, positive: braking",
            .frame = "axis of the generator shaft",
            .alias = alias};
}

}  // namespace

std::vector<Channel> machine_channel_names(const std::string& name, const std::string& alias, bool fed_rotor) {
    std::vector<Channel> all{
        torque_channel(name, alias),
        {.name = name + " power", .units = "W", .long_name = "electric power into the grid"},
        {.name = name + " reactive power", .units = "var", .long_name = "reactive power into the grid"},
        {.name = name + " current", .units = "A", .long_name = "current of a stator phase, root mean square"},
        {.name = name + " current a", .units = "A", .long_name = "current into stator phase a"},
        {.name = name + " current b", .units = "A", .long_name = "current into stator phase b"},
        {.name = name + " current c", .units = "A", .long_name = "current into stator phase c"},
        {.name = name + " voltage", .units = "V", .long_name = "voltage between lines, root mean square"}};
    if (fed_rotor)
        all.push_back({.name = name + " rotor voltage",
                       .units = "V",
                       .long_name = "voltage of the converter at a rotor phase, peak, referred to the stator"});
    return all;
}

void machine_channel_values(const MachineState<double>& at, double omega, double time, bool fed_rotor, double* values) {
    const Phasor<double>&i = at.stator_current, &v = at.voltage;
    const auto phase = [&](double angle) {
        return i.d * std::cos(omega * time + angle) - i.q * std::sin(omega * time + angle);
    };
    const double third = 2 * pi / 3;
    *values++ = at.torque;
    *values++ = -1.5 * (dot(v, i) + dot(at.rotor_voltage, at.rotor_current));
    *values++ = 1.5 * cross(v, i);
    *values++ = std::sqrt(dot(i, i) / 2);
    for (const double angle : {0.0, -third, third}) *values++ = phase(angle);
    *values++ = std::sqrt(1.5 * dot(v, v));
    if (fed_rotor) *values++ = std::sqrt(dot(at.rotor_voltage, at.rotor_voltage));
}

ChannelGroup torque_channels(const std::string& name, const std::string& alias, const ForceElement& element,
                             const MachineConstants& machine) {
    ChannelGroup group;
    group.channels = {
        torque_channel(name, alias),
        {.name = name + " power", .units = "W", .long_name = "power over the air gap: torque times synchronous speed"}};
    group.sample = [element = element.name, speed = machine.omega / machine.pole_pairs](const DynamicView& in,
                                                                                        double* values) {
        const ElementValues own(in.forces.elements(), element, in);
        values[0] = own.view().s(0);
        values[1] = values[0] * speed;
    };
    return group;
}

}  // namespace cardan::detail
