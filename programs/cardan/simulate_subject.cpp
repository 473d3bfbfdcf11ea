#include "elements/machine/coordinate_force.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/aerodynamics/machine_air.hpp"
#include "turbines/machine/machine_text.hpp"
#include "turbines/machine/wind_text.hpp"

#include "programs/cardan/operation.hpp"
#include "programs/cardan/simulate.hpp"
#include "programs/shared/steady_rotation.hpp"
#include <cmath>
#include <iostream>
#include <utility>

namespace cardan::program {

namespace {

// T = torque + slope (speed - speed at the start), of the generator on its own shaft.
struct ConstantGenerator {
    double torque = 0, slope = 0, start = 0, ratio = 1;  // N m, N m s/rad, rad/s, -
    BodyId shaft;

    double at(double rate) const { return torque + slope * (ratio * rate - start); }
    bool acts() const { return torque != 0 || slope != 0; }
};

turbines::Turbine with_generator(const turbines::Turbine& turbine, const ConstantGenerator& generator) {
    if (!generator.acts()) return turbine;
    ForceSet forces = turbine.forces();
    const auto law = [generator](double, double, double rate) {
        return CoordinateLaw{.force = -generator.ratio * generator.at(rate),
                             .by_rate = -generator.ratio * generator.ratio * generator.slope};
    };
    forces.add_user(coordinate_force("generator", generator.shaft, law, false));
    return turbine.with_forces(forces, text("generator: ", generator.torque, " N m + ", generator.slope,
                                            " N m s/rad (speed - ", generator.start, " rad/s), on its own shaft"));
}

ChannelGroup generator_channels(const ConstantGenerator& generator) {
    ChannelGroup group;
    group.channels = {{.name = "generator torque",
                       .units = "N m",
                       .long_name = "torque of the generator, positive: brakes",
                       .frame = "axis of the generator shaft",
                       .alias = "GenTq"},
                      {.name = "generator power",
                       .units = "W",
                       .long_name = "mechanical power taken from the shaft",
                       .frame = "axis of the generator shaft"}};
    group.sample = [generator](const ChannelInput& in, double* values) {
        const double rate = in.qd(in.kinematics.model().index(generator.shaft));
        values[0] = generator.at(rate);
        values[1] = values[0] * generator.ratio * rate;
    };
    return group;
}

std::string options_of(const SimulateArguments& a, double speed, const RotorTorque& rotor) {
    std::string changed;
    for (const std::string& word : a.q) changed += ", q " + word;
    for (const std::string& word : a.qd) changed += ", qd " + word;
    if (a.controller.acts()) changed += ", " + in_words(a.controller);
    if (rotor.acts()) changed += ", " + rotor.in_words();
    if (!a.wind.empty())
        changed += text(", wind ", read_number(a.wind).good() ? a.wind : "of a file", ", ", in_words(a.air), ", ",
                        air_in_words(a.air.wake, false));
    return text("start ", a.start, " at ", speed, " rad/s, azimuth ", a.azimuth, " deg", changed, ", ",
                options_text(a.run));
}

// What is simulated, and what its start is looked for with.
struct Pair {
    turbines::Turbine turbine, at_start;
};

Pair in_the_air(const turbines::Turbine& machine, const std::optional<turbines::MachineAir>& air) {
    if (!air) return {machine, machine};
    return {air->on(machine), air->in(air->wind().at(0)).on(machine)};
}

std::optional<turbines::MachineAir> air_on(const turbines::Turbine& turbine, const turbines::Machine& machine,
                                           const SimulateArguments& a) {
    if (a.wind.empty()) return std::nullopt;
    const turbines::Aerodynamics air = air_of(machine, a.air);
    tell_air("run", air_in_equilibrium(air));
    const SteadyWind profile = wind_profile(a.air, air.density, machine, turbine);
    return turbines::MachineAir(turbine, air.blade, wind_of(a.wind, profile, a.machine.notes), air.options,
                                turbines::support_on(turbine, machine, air.support));
}

// About the shaft, mean over a revolution in steady rotation, N m.
double torque_of(const turbines::MachineAir& air, const turbines::Turbine& at_start, double speed) {
    if (speed == 0) return 0;
    constexpr int azimuths = 24;
    const solvers::PeriodicSteadyState state = [&] {
        try {
            return steady_rotation(at_start, speed, 8, good_start);
        } catch (const NumericalError& error) {
            throw NumericalError(text(error.what(), "; give the generator's torque: --generator-torque"));
        }
    }();
    const Model& model = at_start.system().model;
    Workspace workspace(model);
    double sum = 0;
    for (int i = 0; i < azimuths; ++i) {
        const solvers::OperatingPoint at = state.at(2 * pi * i / azimuths);
        const Kinematics kin = kinematics(model, at.q, workspace);
        sum += air.rotor(ForceInput{0, at.q, at.qd, kin, no_states, no_states}).moment.x();
    }
    return sum / azimuths;
}

// With a generator as the options say.
Subject uncontrolled(const SimulateArguments& a, const Pair& machine, double speed, double rotor_torque) {
    const double ratio = machine.turbine.layout().gear_ratio;
    const ConstantGenerator generator{a.torque.value_or(rotor_torque / ratio), a.slope, ratio * speed, ratio,
                                      *machine.turbine.layout().generator};
    Subject subject{with_generator(machine.turbine, generator),
                    with_generator(machine.at_start, generator),
                    {},
                    {},
                    speed,
                    false,
                    {},
                    {}};
    if (generator.acts()) subject.channels.push_back(generator_channels(generator));
    return subject;
}

Subject controlled(const SimulateArguments& a, const Pair& machine, double speed, double rotor_torque,
                   const std::vector<ChannelGroup>& measured) {
    const turbines::MachineLayout& layout = machine.turbine.layout();
    const double own =
        start_torque(a.controller, layout.gear_ratio, speed, layout.pitch_settings.front(), rotor_torque);
    ControlledMachine under = controlled_machine(a.controller, machine.turbine, a.torque.value_or(own), a.run.out,
                                                 measured, signal::constant(0), actuator_options(a.controller));
    std::cout << "controller: " << under.pitch << "\n";
    return {under.turbine,
            machine.at_start,
            {std::move(under.controller)},
            {std::move(under.channels)},
            speed,
            false,
            {},
            {}};
}

void add_rotor_torque(const RotorTorque& rotor, Subject& subject) {
    if (!rotor.acts()) return;
    const FrameId hub = subject.turbine.layout().hub;
    const auto with = [&](const turbines::Turbine& turbine, FrameLoad load) {
        ForceSet forces = turbine.forces();
        forces.add_wrench(std::move(load));
        return turbine.with_forces(forces, rotor.in_words());
    };
    subject.turbine = with(subject.turbine, rotor.load(hub));
    subject.at_start = with(subject.at_start, rotor.first_load(hub));
    subject.channels.push_back(rotor_torque_channels(rotor, hub));
}

}  // namespace

Subject subject_of(SimulateArguments& a) {
    turbines::Machine machine = prepared_machine(a.machine);
    check_controller(a.controller, machine);
    if (!a.wind.empty()) take_air(machine, a.air, a.machine.notes);
    const RotorTorque rotor = rotor_torque(a.rotor_torque);
    if (a.controller.acts()) make_pitch_drives(a.controller, machine.description);
    if (a.run.out.empty()) a.run.out = default_prefix(a.machine.model, "history");
    const double speed = rotor_speed(a.rpm, machine);
    a.rpm = speed * units::to_rpm;
    set_pitch(machine, a.machine, speed);
    const ReadyMachine ready = ready_machine(machine, a.machine, usual_frequency(machine, a.machine), std::abs(speed));
    std::cout << in_words(ready.mesh) << "\n";
    const std::optional<turbines::MachineAir> air = air_on(ready.turbine, machine, a);
    const Pair pair = in_the_air(ready.turbine, air);
    std::vector<ChannelGroup> wind;
    double driving = 0;
    if (air) {
        wind.push_back(air->channels());
        if (!a.torque && dofs_of(machine.description).generator) driving = torque_of(*air, pair.at_start, speed);
    } else if (a.controller.acts() && rotor.acts()) {
        driving = rotor.first();
    }
    Subject subject =
        a.controller.acts() ? controlled(a, pair, speed, driving, wind) : uncontrolled(a, pair, speed, driving);
    subject.channels.insert(subject.channels.end(), wind.begin(), wind.end());
    add_rotor_torque(rotor, subject);
    subject.driven = !dofs_of(machine.description).generator;
    const std::string foundation = foundation_in_words(machine);
    subject.title = text(machine.description.name, foundation.empty() ? "" : ", ", foundation,
                         a.machine.gravity ? "" : ", no gravity");
    subject.about =
        turbines::with_machine(text(options_of(a, speed, rotor), "\n", air ? turbines::to_yaml(air->wind()) : "",
                                    subject.turbine.rotor().description),
                               std::move(machine));
    return subject;
}

}  // namespace cardan::program
