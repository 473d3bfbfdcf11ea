#include "turbines/actuators/actuators.hpp"

#include "mbs/base/error.hpp"
#include "mbs/kernels/metric.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan::turbines {

namespace {

bool has_spring(const JointSupport& bearing) {
    return bearing.kind == JointSupport::Kind::spring;
}

void for_each_blade(TurbineDescription& machine, const std::function<void(BladeDescription&)>& change) {
    change(machine.blade);
    for (auto& [number, blade] : machine.individual_blades)
        if (blade) change(*blade);
}

// Largest inertia of the blades about their pitch axes, undeformed, kg m^2; 0 also for what is only rounding.
double pitch_inertia(TurbineDescription machine) {
    for_each_blade(machine, [](BladeDescription& blade) { blade.pitch = prescribed_joint; });
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
    for (std::size_t k = 0; k < turbine.layout().pitch.size(); ++k) {
        const int pitch = model.index(turbine.layout().pitch[k]);
        const CardanBeam& blade = turbine.layout().blades[k];
        const double J = g(pitch, pitch), whole = blade.mass * blade.line.length * blade.line.length;
        if (J > 1e-12 * whole) largest = std::max(largest, J);
    }
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
    for (const ForceElement& element : all.elements()) rest.add_element(element);
    for (const InputInfo& input : all.inputs()) rest.add_input(input);
    rest.set_gravity(all.gravity());
    return rest;
}

std::string pitch_input(int blade) {
    return text("blade ", blade, " pitch demand");
}

constexpr const char *collective_input = "pitch demand", *torque_input = "torque demand";
constexpr double torque_scale = 4e4, pitch_scale = 0.2;

// Of the pitch bearing alone, if it has any.
const LinearLaw* spring_of(const ForceSet& forces, BodyId coordinate) {
    const std::vector<LinearLaw>& laws = forces.laws();
    const auto law = std::ranges::find_if(laws, [&](const LinearLaw& l) { return holds_only(l, coordinate); });
    return law == laws.end() || !(law->stiffness(0, 0) > 0) ? nullptr : &*law;
}

// The demand moves the spring's rest: what it does counts as put in from outside.
ForceElement moved_rest(const std::string& name, const ControlSignal& rest, BodyId coordinate, double stiffness) {
    ForceElement element = signal_force(name, rest, coordinate, stiffness);
    element.power = [evaluate = element.evaluate](const ElementView& in) {
        Eigen::Matrix<double, 1, 1> Q = Eigen::Matrix<double, 1, 1>::Zero();
        Vector none;
        ElementForces out{Q, none, {}};
        evaluate(in, out);
        return ElementPower{0, Q(0) * in.qd(0), 0};
    };
    return element;
}

}  // namespace

std::string pitch_state(int blade) {
    return text("blade ", blade, " pitch actuator");
}

void give_pitch_drives(TurbineDescription& machine) {
    for_each_blade(machine, [&](BladeDescription& blade) {
        if (blade.linkage)
            throw InputError(machine.name, "pitch linkage", "a push rod that turns the blade",
                             "none where a controller sets the pitch");
        if (!has_spring(blade.pitch)) blade.pitch = prescribed_joint;
    });
}

void give_pitch_springs(TurbineDescription& machine, double frequency, double damping) {
    require_positive(machine.name, "frequency of the pitch drives [rad/s]", frequency);
    require_not_negative(machine.name, "damping ratio of the pitch drives", damping);
    bool all = true;
    for_each_blade(machine, [&](const BladeDescription& blade) { all = all && has_spring(blade.pitch); });
    if (all) return;
    const double J = pitch_inertia(machine);
    if (!(J > 0))
        throw InputError(machine.name, "inertia of the blades about their pitch axes [kg m^2]", J,
                         "> 0 (BladeDescription::pitch_inertia, BlPIner of ElastoDyn) for a drive with a spring; "
                         "without inertia the pitch can be prescribed");
    const JointSupport drive{frequency * frequency * J, 2 * damping * frequency * J};
    for_each_blade(machine, [&](BladeDescription& blade) {
        if (!has_spring(blade.pitch)) blade.pitch = drive;
    });
}

ActuatedForces::ActuatedForces(const Turbine& turbine, ActuatorOptions options)
    : layout_(turbine.layout()),
      options_(options),
      rest_(options.pitch_frequency > 0 ? without_springs(turbine.forces(), layout_.pitch) : turbine.forces()) {
    const std::string& name = turbine.rotor().machine;
    if (!layout_.generator) throw InputError(name, "generator", "none", "one whose torque can be set");
    if (layout_.pitch.empty())
        throw InputError(name, "blades with pitch joints", 0,
                         "at least one: give_pitch_drives() prescribes the pitch, give_pitch_springs() makes bearings");
    require_not_negative(name, "frequency of the pitch actuators [rad/s]", options_.pitch_frequency);
    require_not_negative(name, "maximum rate of the pitch actuators [rad/s]", options_.max_pitch_rate);
    const Model& model = turbine.system().model;
    for (std::size_t k = 0; k < layout_.pitch.size(); ++k) {
        PitchBearing bearing{model.index(layout_.pitch[k])};
        bearing.prescribed = model.coordinates()[bearing.coordinate].role == CoordinateRole::prescribed;
        const LinearLaw* const spring = spring_of(turbine.forces(), layout_.pitch[k]);
        const std::string where = text("pitch bearing of blade ", layout_.blade_numbers[k]);
        if (!bearing.prescribed && !spring)
            throw InputError(name, where, "without a spring",
                             "one with a spring, or prescribed: see give_pitch_drives()");
        if (bearing.prescribed && options_.pitch_frequency > 0)
            throw InputError(name, where, "prescribed",
                             "one with a spring, to which an actuator is put in series: see give_pitch_springs()");
        if (!bearing.prescribed) {
            bearing.stiffness = spring->stiffness(0, 0);
            bearing.damping = spring->damping(0, 0);
        }
        bearings_.push_back(bearing);
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

std::vector<InputDrive> ActuatedForces::drives(bool individual) const {
    std::vector<InputDrive> all;
    const std::vector<std::string> names = inputs(individual);
    for (std::size_t k = 0; k < bearings_.size(); ++k)
        if (bearings_[k].prescribed)
            all.push_back({bearings_[k].coordinate, names[individual ? k : 0], -1, layout_.pitch_settings[k]});
    return all;
}

std::string ActuatedForces::in_words(const PitchBearing& bearing) const {
    if (bearing.prescribed) return "pitch prescribed, one period behind the demand";
    if (options_.pitch_frequency == 0)
        return text("pitch on the spring of its bearing, ", bearing.stiffness, " N m/rad and ", bearing.damping,
                    " N m s/rad, which rests at the demand");
    const std::string limit = options_.max_pitch_rate == 0
                                  ? std::string()
                                  : text(", at most ", options_.max_pitch_rate * units::to_degrees, " deg/s");
    return text("pitch actuator of second order, ", options_.pitch_frequency / (2 * pi), " Hz, damping ",
                options_.pitch_damping, limit, ", before the spring of the bearing");
}

std::string ActuatedForces::in_words() const {
    std::vector<std::string> all;
    for (const PitchBearing& bearing : bearings_) all.push_back(in_words(bearing));
    if (std::ranges::all_of(all, [&](const std::string& one) { return one == all.front(); })) return all.front();
    std::string out;
    for (std::size_t k = 0; k < all.size(); ++k)
        out += text(k == 0 ? "" : "; ", "blade ", layout_.blade_numbers[k], ": ", all[k]);
    return out;
}

ForceSet ActuatedForces::with_inputs(double torque, bool individual, const ControlSignal& more) const {
    ActuatorDemands demands{{}, signal::input(torque_input) + more};
    const std::vector<std::string> names = inputs(individual);
    for (std::size_t i = 0; i + 1 < names.size(); ++i) demands.pitch.push_back(signal::input(names[i]));
    ForceSet forces = with_any(demands, torque);
    for (std::size_t i = 0; i + 1 < names.size(); ++i)
        forces.add_input({.name = names[i], .unit = "rad", .scale = pitch_scale, .initial = layout_.pitch_settings[i]});
    forces.add_input({.name = torque_input, .unit = "N m", .scale = torque_scale, .initial = torque});
    return forces;
}

ForceSet ActuatedForces::with_demands(const ActuatorDemands& demands, double torque) const {
    const std::size_t blades = layout_.pitch.size();
    if (demands.pitch.size() != 1 && demands.pitch.size() != blades)
        throw InputError("actuators", "number of pitch demands", demands.pitch.size(), text("1 or ", blades));
    for (std::size_t k = 0; k < blades; ++k)
        if (bearings_[k].prescribed)
            throw InputError("actuators", text("pitch of blade ", layout_.blade_numbers[k]), "prescribed",
                             "held by a spring: see give_pitch_springs(); a sampled controller prescribes it, see "
                             "with_inputs()");
    return with_any(demands, torque);
}

void ActuatedForces::add_pitch(ForceSet& forces, std::size_t k, const ControlSignal& demand) const {
    const PitchBearing& bearing = bearings_[k];
    const double setting = layout_.pitch_settings[k];
    const int number = layout_.blade_numbers[k];
    if (bearing.prescribed) return;
    if (options_.pitch_frequency == 0) {
        forces.add_element(moved_rest(text("blade ", number, " pitch demand on its spring"),
                                      signal::constant(setting) - demand, layout_.pitch[k], bearing.stiffness));
        return;
    }
    Actuator drive{.name = {.name = pitch_state(number),
                            .unit = "rad",
                            .scale = pitch_scale,
                            .initial = setting,
                            .part = "pitch",
                            .blade = number},
                   .demand = demand,
                   .frequency = options_.pitch_frequency,
                   .damping = options_.pitch_damping};
    if (options_.max_pitch_rate > 0) drive.rates = {-options_.max_pitch_rate, options_.max_pitch_rate};
    forces.add_element(
        position_actuator(drive, layout_.pitch[k], bearing.stiffness, bearing.damping, -1, setting).element);
}

ForceSet ActuatedForces::with_any(const ActuatorDemands& demands, double torque) const {
    ForceSet forces = rest_;
    for (std::size_t k = 0; k < bearings_.size(); ++k)
        add_pitch(forces, k, demands.pitch[demands.pitch.size() == 1 ? 0 : k]);
    Actuator generator{
        .name = {.name = torque_state, .unit = "N m", .scale = torque_scale, .initial = torque, .part = "generator"},
        .demand = demands.torque,
        .time_constant = options_.torque_time_constant};
    if (options_.max_torque_rate > 0) generator.rates = {-options_.max_torque_rate, options_.max_torque_rate};
    forces.add_element(options_.torque_on_shaft
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
        group.sample = [places](const DynamicView& in, double* values) {
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
                       const DynamicView& in, double* values) {
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
