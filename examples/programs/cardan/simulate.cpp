// Motion of any machine in time, from a start in steady rotation or at rest.
//
// Problem: a machine (built in, or a file of OpenFAST, windIO or our own) starts at a rotor speed in its steady state
// under gravity, periodic where it is: two blades, unequal blades, gravity itself. From there its equations of motion
// are integrated with the rotor free, against a constant torque of the generator or one that rises with its speed, or
// driven at constant speed; or under a controller, which sets pitch and torque of the generator. Coordinates may start
// elsewhere, to see their motion decay. What drives the rotor is the air, steady or over time, or a given torque.
// Checks: the energy balance, by the integration and by the recorded powers of generator, air and rotor torque.
#include "elements/machine/coordinate_force.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/outcome.hpp"
#include "mbs/base/units.hpp"
#include "turbines/aerodynamics/machine_air.hpp"
#include "turbines/model/channels.hpp"

#include "examples/programs/cardan/air.hpp"
#include "examples/programs/cardan/commands.hpp"
#include "examples/programs/cardan/operation.hpp"
#include "examples/shared/channel_choice.hpp"
#include "examples/shared/controller.hpp"
#include "examples/shared/named_values.hpp"
#include "examples/shared/rotor_torque.hpp"
#include "examples/shared/simulation_run.hpp"
#include "examples/shared/steady_rotation.hpp"
#include <algorithm>

namespace cardan::program {

namespace {

struct SimulateArguments {
    MachineOptions machine;
    RunArguments run;
    StationOptions stations;
    ControllerOptions controller;
    AirArguments air;
    std::optional<double> rpm, torque;
    std::string start = "steady", rotor_torque, wind;
    double azimuth = 0, slope = 0;
    bool no_gravity = false, list = false;
    std::vector<std::string> plot, q, qd;
};

void declare(CommandLine& app, SimulateArguments& a) {
    a.run.duration = 20;
    add_machine(app, a.machine);
    add_run_options(app, a.run);
    add_station_options(app, a.stations);
    app.add_option("--rpm", a.rpm, "rotor speed at the start, rev/min (default: the model's)");
    app.add_option("--azimuth", a.azimuth, "azimuth of blade 1 at the start, deg, zero upward");
    app.add_option("--start", a.start, "steady: bent as in steady rotation, or at rest; undeformed: straight")
        .one_of({"steady", "undeformed"});
    app.add_option("--q", a.q, "COORDINATE=NUMBER: where it starts instead, rad or m; may be repeated").one_word();
    app.add_option("--qd", a.qd, "COORDINATE=NUMBER: its rate, rad/s or m/s; may be repeated").one_word();
    app.add_option(
        "--generator-torque", a.torque,
        "of the generator on its own shaft, N m, constant, or with a controller at the start; positive brakes "
        "positive rotation (default: none; in the wind that of the air in steady rotation)");
    app.add_option("--generator-slope", a.slope,
                   "rise of this torque with the generator's speed above that at the start, as of slip, N m s/rad");
    app.add_option("--wind", a.wind, std::string("speed at the hub's height: ") + wind_file_format)
        .type_name("SPEED|FILE");
    add_air_options(app, a.air);
    add_rotor_torque(app, a.rotor_torque);
    add_controller_options(app, a.controller);
    app.add_flag("--no-gravity", a.no_gravity, "without gravity");
    add_machine_options(app, a.machine);
    app.add_option("--plot", a.plot,
                   "channels of one panel of the pictures, by name or alias, joined by +: TTDspFA+TTDspSS; may be "
                   "repeated (default: speeds, deflections and loads)")
        .one_word();
    app.add_flag("--list", a.list, "print the channels and end");
    app.add_flag("--resume", a.run.resume,
                 "go on with PREFIX.h5 from where it was broken off, or beyond its end; same options but --duration");
}

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

solvers::OperatingPoint at_rest(const turbines::Turbine& turbine, double azimuth) {
    solvers::SteadyOptions options;
    options.azimuth = azimuth;
    const solvers::SteadyState state = solvers::steady_state(turbine.system(), turbine.rotor().spin, options);
    require_result(state);
    return state.at;
}

constexpr double good_start = 1e-6;  // rad or m

// Empty, with the reason printed: there is no steady state, or it was not found.
std::optional<Start> steady_start(const turbines::Turbine& turbine, double speed, double azimuth) {
    try {
        const solvers::OperatingPoint at =
            speed == 0 ? at_rest(turbine, azimuth) : steady_rotation(turbine, speed, 8, good_start).at(azimuth);
        return Start{at.q, at.qd};
    } catch (const NumericalError& error) {
        std::cout << "note: the start is undeformed: " << error.what() << "\n";
        return std::nullopt;
    }
}

Start start_of(const SimulateArguments& a, const turbines::Turbine& turbine, double speed) {
    const System& system = turbine.system();
    const int spin = turbine.rotor().spin;
    const double azimuth = a.azimuth * units::degree;
    std::optional<Start> start;
    if (a.start == "steady") start = steady_start(turbine, speed, azimuth);
    if (!start) start = {Vector::Zero(system.model.size()), Vector::Zero(system.model.size())};
    start->q(spin) = azimuth;
    start->qd(spin) = speed;
    const CoordinateTable& table = system.model.coordinates();
    return {named_values("--q", a.q, table, start->q, false), named_values("--qd", a.qd, table, start->qd, false)};
}

// What the controller sets beside what comes of it, then the usual ones.
std::vector<solvers::HistoryPanel> controlled_panels(const turbines::MachineLayout& layout,
                                                     const std::vector<Channel>& channels) {
    std::vector<solvers::HistoryPanel> all = usual_panels(layout, channels);
    std::erase_if(all, [](const solvers::HistoryPanel& panel) { return panel.channels.front() == "GenTq"; });
    const std::string blade = text("blade ", layout.blade_numbers.front()), own = blade + " pitch demand";
    const std::vector<solvers::HistoryPanel> first{
        {{has(channels, own) ? own : "pitch demand", blade + " pitch angle"}},
        {{"torque demand", "generator torque"}},
        {{"generator power"}}};
    all.insert(all.begin() + (all.empty() ? 0 : 1), first.begin(), first.end());
    return all;
}

// In the air: the wind first, the power of the air with that of the generator.
std::vector<solvers::HistoryPanel> with_air(std::vector<solvers::HistoryPanel> all) {
    const std::string power = "aerodynamic power";
    const auto generator = std::ranges::find_if(
        all, [](const solvers::HistoryPanel& panel) { return panel.channels.front() == "generator power"; });
    if (generator == all.end())
        all.insert(all.begin() + (all.empty() ? 0 : 1), {{power}});
    else
        generator->channels.insert(generator->channels.begin(), power);
    all.insert(all.begin(), {{"wind speed"}});
    return all;
}

// What was asked for, or what there is of the usual ones.
std::vector<solvers::HistoryPanel> panels(const SimulateArguments& a, const turbines::MachineLayout& layout,
                                          const std::vector<Channel>& channels) {
    if (a.plot.empty()) {
        const auto usual = a.controller.acts() ? controlled_panels(layout, channels) : usual_panels(layout, channels);
        return a.wind.empty() ? usual : with_air(usual);
    }
    std::vector<solvers::HistoryPanel> all;
    const solvers::History names{"--plot", channels, {}, {}};
    for (const std::string& joined : a.plot) {
        all.push_back(panel_of(joined));
        for (const std::string& channel : all.back().channels) static_cast<void>(names.index(channel));
    }
    return all;
}

void print(const std::vector<Channel>& channels) {
    for (const Channel& c : channels)
        std::printf("%-44s %-10s %-8s %s\n", c.name.c_str(), c.alias.c_str(), c.units.c_str(), c.long_name.c_str());
}

std::string options_of(const SimulateArguments& a, double speed, const RotorTorque& rotor) {
    std::string changed;
    for (const std::string& word : a.q) changed += ", q " + word;
    for (const std::string& word : a.qd) changed += ", qd " + word;
    if (a.controller.acts()) changed += ", " + in_words(a.controller);
    if (rotor.acts()) changed += ", " + rotor.in_words();
    if (!a.wind.empty()) changed += text(", wind ", a.wind, ", ", in_words(a.air));
    return text("start ", a.start, " at ", speed, " rad/s, azimuth ", a.azimuth, " deg", changed, ", ",
                options_text(a.run));
}

// A rotor that is driven turns on at the speed of the start.
std::vector<solvers::Drive> drives(bool driven, int spin, const Start& start) {
    if (!driven) return {};
    return {{spin, solvers::Motion::constant_rate(start.q(spin), start.qd(spin))}};
}

// Of the loads that are recorded, J; positive: put into the machine.
double recorded_work(const solvers::History& history) {
    double sum = 0;
    if (has(history.channels, "generator power")) sum -= integral(history, "generator power");
    for (const char* driving : {"rotor torque power", "work rate of the air"})
        if (has(history.channels, driving)) sum += integral(history, driving);
    return sum;
}

bool check_balance(solvers::Integrator& integrator, const solvers::History& history, const SimulateArguments& a) {
    const solvers::EnergyBalance end = integrator.energy();
    const double kinetic = largest(history, "kinetic energy").value;
    const double exchanged = exchanged_energy(history);
    const bool parked = exchanged > kinetic;
    const double scale = parked ? exchanged : kinetic;
    std::printf("\n");
    bool good = check_energy(end, scale, 10 * a.run.tolerance, parked);
    std::string loads;
    for (const auto& [channel, name] : {std::pair("generator power", "generator"),
                                        {"rotor torque power", "rotor torque"},
                                        {"work rate of the air", "air"}})
        if (has(history.channels, channel)) loads += text(loads.empty() ? "" : ", ", name);
    if (!loads.empty() && history.time.size() > 1) {
        // What pitch drives do counts as a load as well.
        const double pitching = end.state_supply - end.state_dissipation;
        good = check(text("recorded power of ", loads, " against its work, likewise").c_str(),
                     (end.loads - pitching - recorded_work(history)) / scale, a.run.step / 4) &&
               good;
    }
    return good;
}

// The machine as it runs here.
struct Subject {
    turbines::Turbine turbine;
    turbines::Turbine at_start;  // the same without anything that changes: springs in the place of actuators
    std::vector<solvers::SampledController> controllers;
    std::vector<ChannelGroup> channels;  // beside those of any machine
    double speed;                        // rad/s, at the start
    bool driven;
    std::string title, about;  // for the file: without the command, which differs if a run goes on
};

// What is simulated, and what its start is looked for with.
struct Pair {
    turbines::Turbine turbine, at_start;
};

Pair in_the_air(const turbines::Turbine& machine, const std::optional<turbines::MachineAir>& air) {
    if (!air) return {machine, machine};
    return {air->on(machine), air->in(air->wind().at(0)).on(machine)};
}

std::optional<turbines::MachineAir> air_on(const turbines::Turbine& turbine, const MachineFile& machine,
                                           const SimulateArguments& a) {
    if (a.wind.empty()) return std::nullopt;
    const Air air = air_of(machine, a.machine, a.air);
    const SteadyWind profile = wind_profile(a.air, air, turbines::hub_at_rest(turbine).z());
    return turbines::MachineAir(turbine, air.blade, wind_of(a.wind, profile, a.machine.notes), air.options);
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
        sum += air.rotor({0, at.q, at.qd, kin, no_states, no_states}).moment.x();
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
    ControlledMachine under =
        controlled_machine(a.controller, machine.turbine, a.torque.value_or(own), a.run.out, measured);
    return {under.turbine, machine.at_start, {std::move(under.controller)}, {std::move(under.channels)}, speed, false,
            {},            {}};
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

Subject subject_of(SimulateArguments& a) {
    MachineFile machine = prepared_machine(a.machine);
    check_controller(a.controller, machine);
    const RotorTorque rotor = rotor_torque(a.rotor_torque);
    if (a.controller.acts()) turbines::give_pitch_springs(machine.file.description);
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
        if (!a.torque && machine.file.dofs.generator) driving = torque_of(*air, pair.at_start, speed);
    } else if (a.controller.acts() && rotor.acts()) {
        driving = rotor.first();
    }
    Subject subject = a.controller.acts() ? controlled(a, pair, speed, driving, wind)
                                          : uncontrolled(a, pair, speed, driving);
    subject.channels.insert(subject.channels.end(), wind.begin(), wind.end());
    add_rotor_torque(rotor, subject);
    subject.driven = !machine.file.dofs.generator;
    const std::string foundation = foundation_in_words(machine);
    subject.title = text(machine.file.description.name, foundation.empty() ? "" : ", ", foundation,
                         a.machine.gravity ? "" : ", no gravity");
    subject.about = text(options_of(a, speed, rotor), "\n", subject.turbine.rotor().description);
    return subject;
}

void print_result(const Subject& subject, const SimulateArguments& a, solvers::Integrator& integrator,
                  const solvers::History& history) {
    std::printf("%s: from %g rpm, rotor %s, %g s\n", subject.title.c_str(), *a.rpm, subject.driven ? "driven" : "free",
                integrator.time());
    const std::vector<std::string> names = main_channels(subject.turbine.layout(), history.channels);
    std::vector<const char*> shown;
    shown.reserve(names.size());
    for (const std::string& name : names) shown.push_back(name.c_str());
    print_largest(history, shown);
}

std::vector<solvers::HistoryPanel> spectra_of(const turbines::MachineLayout& layout) {
    std::vector<solvers::HistoryPanel> spectra;
    if (layout.tower) spectra.push_back({{"YawBrTAxp", "YawBrTAyp"}});
    if (const auto blade = blade_panels(layout); !blade.empty()) spectra.push_back(panel_of(blade.back()));
    return spectra;
}

int run(SimulateArguments& a, const CommandLine& command) {
    check_run_options(a.run);
    if (a.controller.acts() && a.slope != 0)
        throw InputError("--generator-slope", "value", a.slope, "none beside --controller, which sets the torque");
    if (a.run.resume && a.controller.acts() && !a.controller.is_baseline())
        throw InputError("--resume", "controller", a.controller.what,
                         "baseline: a library keeps its memory to itself, so that its run cannot go on");
    a.machine.gravity = !a.no_gravity;
    const Subject subject = subject_of(a);
    const turbines::Turbine& turbine = subject.turbine;
    const System& system = turbine.system();
    const int spin = turbine.rotor().spin;
    if (!a.run.resume && !a.list) check_outputs(a.run.out, run_outputs);
    const std::optional<solvers::Checkpoint> broken_off = start_of(a.run, subject.about);
    const Start start = start_of(a, subject.at_start, subject.speed);
    solvers::IntegrationOptions options = integration_options(a.run);
    options.controllers = subject.controllers;
    const std::vector<solvers::Drive> drive = drives(subject.driven, spin, start);
    solvers::Integrator integrator = broken_off ? solvers::Integrator(system, drive, *broken_off, options)
                                                : solvers::Integrator(system, drive, 0, start.q, start.qd, options);
    std::vector<ChannelGroup> channels = channels_of(turbine, a.stations);
    channels.insert(channels.end(), subject.channels.begin(), subject.channels.end());
    solvers::Recorder recorder(integrator, channels);
    if (a.list) return print(recorder.channels()), 0;
    const std::vector<solvers::HistoryPanel> pictures = panels(a, turbine.layout(), recorder.channels());
    Rows rows = broken_off
                    ? Rows(a.run, integrator, recorder)
                    : Rows(subject.title, run_text("simulate", command) + subject.about, a.run, integrator, recorder);

    const Stopwatch watch;
    const solvers::Advance end = record(integrator, recorder, 0, a.run.duration, a.run.step, rows);
    const Elapsed elapsed = watch.elapsed();
    progress("\r                              \r");

    print_result(subject, a, integrator, rows.history);
    const bool good = check_balance(integrator, rows.history, a);
    print_effort(integrator, system, elapsed);
    write_outputs(rows, a.run.out, end.reached(), pictures, spectra_of(turbine.layout()),
                  {.from = integrator.time() / 2,
                   .blades = static_cast<int>(turbine.layout().blades.size()),
                   .max_frequency_hz = 8});
    if (!end.reached()) return 130;
    return good ? 0 : 1;
}

}  // namespace

int simulate_command(int argc, char** argv) {
    return run_command<SimulateArguments>(
        "cardan simulate",
        "Motion of any machine in time: gravity, wind, a rotor that is free or driven, a generator, a controller.\n"
        "Prints the largest loads and the balance of energy; writes PREFIX.h5, .svg, .png, _energy.png and "
        "_spectrum.png (second half).",
        argc, argv, declare, run);
}

}  // namespace cardan::program
