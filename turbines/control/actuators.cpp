#include "turbines/control/actuators.hpp"

#include "mbs/base/error.hpp"
#include "mbs/kernels/metric.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace cardan::turbines {

namespace {

bool has_spring(const Bearing& bearing) {
    return bearing.hold == Bearing::Hold::spring;
}

void for_each_blade(TurbineDescription& machine, const std::function<void(BladeDescription&)>& change) {
    change(machine.blade);
    for (auto& [number, blade] : machine.own_blades)
        if (blade) change(*blade);
}

// Largest inertia of the blades about their pitch axes, undeformed, kg m^2.
double pitch_inertia(TurbineDescription machine) {
    for_each_blade(machine, [](BladeDescription& blade) { blade.pitch = free_joint; });
    machine.tower.rigid = true;
    machine.platform.reset();
    AssemblyOptions options;
    options.structural_damping = false;
    options.blade_beam = CardanBeamOptions{};  // how it bends does not matter
    options.blade_beam->torsion = options.blade_beam->extension = false;
    const Turbine turbine = assemble(machine, options);
    const Model& model = turbine.system().model;
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, Vector::Zero(model.size()), workspace);
    Matrix g(model.size(), model.size());
    metric(kin, g);
    double largest = 0;
    for (const BodyId pitch : turbine.layout().pitch)
        largest = std::max(largest, g(model.index(pitch), model.index(pitch)));
    return largest;
}

// Of one coordinate alone; none: its law holds others as well, or there is none.
bool holds_only(const LinearLaw& law, BodyId coordinate) {
    return law.coordinates.size() == 1 && law.coordinates.front() == coordinate;
}

ForceSet without_springs(const ForceSet& all, const std::vector<BodyId>& coordinates) {
    ForceSet rest;
    for (const LinearLaw& law : all.laws())
        if (std::ranges::none_of(coordinates, [&](BodyId at) { return holds_only(law, at); })) rest.add_law(law);
    for (const FrameLoad& load : all.loads()) rest.add_wrench(load);
    for (const UserForce& force : all.users()) rest.add_user(force);
    for (const WrenchField& field : all.fields()) rest.add_field(field);
    for (const StateElement& element : all.state_elements()) rest.add_states(element);
    for (const InputInfo& input : all.inputs()) rest.add_input(input);
    rest.set_gravity(all.gravity());
    return rest;
}

std::string pitch_input(int blade) {
    return text("blade ", blade, " pitch demand");
}

constexpr const char *collective_input = "pitch demand", *torque_input = "torque demand";
constexpr double torque_scale = 4e4, pitch_scale = 0.2;

}  // namespace

std::string pitch_state(int blade) {
    return text("blade ", blade, " pitch actuator");
}

void give_pitch_springs(TurbineDescription& machine, double frequency, double damping) {
    require_positive(machine.name, "frequency of the pitch drives [rad/s]", frequency);
    require_not_negative(machine.name, "damping ratio of the pitch drives", damping);
    bool all = true;
    for_each_blade(machine, [&](const BladeDescription& blade) { all = all && has_spring(blade.pitch); });
    if (all) return;
    const double J = pitch_inertia(machine);
    require_positive(machine.name, "inertia of the blades about their pitch axes [kg m^2]", J);
    const Bearing drive{frequency * frequency * J, 2 * damping * frequency * J};
    for_each_blade(machine, [&](BladeDescription& blade) {
        if (!has_spring(blade.pitch)) blade.pitch = drive;
    });
}

ActuatedForces::ActuatedForces(const Turbine& turbine, ActuatorOptions options)
    : layout_(turbine.layout()), options_(options), rest_(without_springs(turbine.forces(), layout_.pitch)) {
    const std::string& name = turbine.rotor().machine;
    if (!layout_.generator) throw InputError(name, "generator", "none", "one whose torque can be set");
    if (layout_.pitch.empty())
        throw InputError(name, "blades with pitch joints", 0, "at least one: give_pitch_springs() makes bearings");
    for (std::size_t k = 0; k < layout_.pitch.size(); ++k) {
        const std::vector<LinearLaw>& laws = turbine.forces().laws();
        const auto law =
            std::ranges::find_if(laws, [&](const LinearLaw& l) { return holds_only(l, layout_.pitch[k]); });
        if (law == laws.end() || !(law->stiffness(0, 0) > 0))
            throw InputError(name, text("pitch bearing of blade ", layout_.blade_numbers[k]), "without a spring",
                             "one with a spring, to which an actuator is put in series");
        springs_.push_back({law->stiffness(0, 0), law->damping(0, 0)});
    }
}

std::vector<std::string> ActuatedForces::inputs(bool individual) const {
    std::vector<std::string> names;
    if (!individual)
        names.emplace_back(collective_input);
    else
        for (const int number : layout_.blade_numbers) names.push_back(pitch_input(number));
    names.emplace_back(torque_input);
    return names;
}

ForceSet ActuatedForces::with_inputs(double torque, bool individual, const ControlSignal& more) const {
    ActuatorDemands demands{{}, signal::input(torque_input) + more};
    const std::vector<std::string> names = inputs(individual);
    for (std::size_t i = 0; i + 1 < names.size(); ++i) demands.pitch.push_back(signal::input(names[i]));
    ForceSet forces = with_demands(demands, torque);
    for (std::size_t i = 0; i + 1 < names.size(); ++i)
        forces.add_input({.name = names[i], .unit = "rad", .scale = pitch_scale, .initial = layout_.pitch_settings[i]});
    forces.add_input({.name = torque_input, .unit = "N m", .scale = torque_scale, .initial = torque});
    return forces;
}

ForceSet ActuatedForces::with_demands(const ActuatorDemands& demands, double torque) const {
    const std::size_t blades = layout_.pitch.size();
    if (demands.pitch.size() != 1 && demands.pitch.size() != blades)
        throw InputError("actuators", "number of pitch demands", demands.pitch.size(), text("1 or ", blades));
    ForceSet forces = rest_;
    const double fastest = options_.largest_pitch_rate;
    for (std::size_t k = 0; k < blades; ++k) {
        const double setting = layout_.pitch_settings[k];
        const int number = layout_.blade_numbers[k];
        const Actuator drive{.name = {.name = pitch_state(number),
                                      .unit = "rad",
                                      .scale = pitch_scale,
                                      .initial = setting,
                                      .part = "pitch",
                                      .blade = number},
                             .demand = demands.pitch[demands.pitch.size() == 1 ? 0 : k],
                             .frequency = options_.pitch_frequency,
                             .damping = options_.pitch_damping,
                             .rates = {-fastest, fastest}};
        const auto [stiffness, damping] = springs_[k];
        forces.add_states(position_actuator(drive, layout_.pitch[k], stiffness, damping, -1, setting).element);
    }
    Actuator generator{
        .name = {.name = torque_state, .unit = "N m", .scale = torque_scale, .initial = torque, .part = "generator"},
        .demand = demands.torque,
        .time_constant = options_.torque_time_constant};
    if (options_.largest_torque_rate > 0)
        generator.rates = {-options_.largest_torque_rate, options_.largest_torque_rate};
    forces.add_states(options_.torque_on_shaft
                          ? force_actuator(generator, *layout_.generator, -layout_.gear_ratio).element
                          : actuator(generator).element);
    return forces;
}

ChannelGroup ActuatedForces::channels(const System& system, bool individual, double efficiency) const {
    ChannelGroup group;
    std::vector<int> places;
    const std::string axis = "axis of the generator shaft";
    for (const std::string& name : inputs(individual)) {
        places.push_back(system.forces.inputs().index(name));
        const bool torque = name == torque_input;
        group.channels.push_back(
            {.name = name,
             .units = torque ? "N m" : "rad",
             .long_name = torque ? "torque of the generator as the controller demands it"
                                 : text("pitch as the controller demands it, towards feather",
                                        individual ? text(", ", name.substr(0, name.find(" p"))) : ""),
             .frame = torque ? axis : "pitch axis"});
    }
    if (!options_.torque_on_shaft) {
        group.sample = [places](const ChannelInput& in, double* values) {
            for (const int place : places) *values++ = in.u(place);
        };
        return group;
    }
    group.channels.push_back({.name = "generator torque",
                              .units = "N m",
                              .long_name = "torque of the generator, positive: brakes",
                              .frame = axis,
                              .alias = "GenTq"});
    group.channels.push_back(
        {.name = "generator power", .units = "W", .long_name = "mechanical power taken from the shaft", .frame = axis});
    group.channels.push_back(
        {.name = "electrical power", .units = "W", .long_name = "power of the generator", .alias = "GenPwr"});
    const int torque = system.forces.states().index(torque_state);
    group.sample = [places, torque, efficiency, shaft = *layout_.generator, ratio = layout_.gear_ratio](
                       const ChannelInput& in, double* values) {
        for (const int place : places) *values++ = in.u(place);
        const double power = in.s(torque) * ratio * in.qd(in.kinematics.model().index(shaft));
        *values++ = in.s(torque);
        *values++ = power;
        *values = efficiency * power;
    };
    return group;
}

ControlSignal generator_speed(const MachineLayout& layout) {
    if (!layout.generator) throw InputError("signal of the generator's speed", "generator", "none", "one");
    return layout.gear_ratio * signal::rate(*layout.generator);
}

ControlSignal mean_pitch(const MachineLayout& layout) {
    if (layout.pitch.empty()) throw InputError("signal of the pitch", "blades with pitch joints", 0, "at least one");
    const double share = 1 / static_cast<double>(layout.pitch.size());
    ControlSignal mean = signal::constant(0);
    for (std::size_t k = 0; k < layout.pitch.size(); ++k)
        mean = mean + share * (signal::constant(layout.pitch_settings[k]) - signal::position(layout.pitch[k]));
    return mean;
}

}  // namespace cardan::turbines
