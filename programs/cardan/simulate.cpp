// Motion of any machine in time, from a start in steady rotation or at rest.
//
// Problem: a machine (built in, or a file of OpenFAST, windIO or our own) starts at a rotor speed in its steady state
// under gravity, periodic where it is: two blades, unequal blades, gravity itself. From there its equations of motion
// are integrated with the rotor free, against a constant torque of the generator or one that rises with its speed, or
// driven at constant speed; or under a controller, which sets pitch and torque of the generator. Coordinates may start
// elsewhere, to see their motion decay. What drives the rotor is the air, steady or over time, or a given torque.
// Checks: the energy balance, by the integration and by the recorded powers of generator, air and rotor torque.
#include "programs/cardan/simulate.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/outcome.hpp"
#include "mbs/base/units.hpp"
#include "turbines/model/channels.hpp"

#include "programs/cardan/commands.hpp"
#include "programs/shared/channel_choice.hpp"
#include "programs/shared/named_values.hpp"
#include "programs/shared/steady_rotation.hpp"
#include <algorithm>
#include <cmath>

namespace cardan::program {

namespace {

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
    add_wake_option(app, a.air);
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

solvers::OperatingPoint at_rest(const turbines::Turbine& turbine, double azimuth) {
    solvers::SteadyOptions options;
    options.azimuth = azimuth;
    const solvers::SteadyState state = solvers::steady_state(turbine.system(), turbine.rotor().spin, options);
    require_result(state);
    return state.at;
}

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

// A rotor that is driven turns on at the speed of the start.
std::vector<solvers::Drive> drives(bool driven, int spin, const Start& start) {
    if (!driven) return {};
    return {{spin, solvers::Motion::constant_rate(start.q(spin), start.qd(spin))}};
}

// Of the loads that are recorded, J; positive: put into the machine. From each so many-th sample.
double recorded_work(const solvers::History& history, std::size_t every) {
    double sum = 0;
    if (has(history.channels, "generator power")) sum -= integral(history, "generator power", "", every);
    for (const char* driving : {"rotor torque power", "work rate of the air"})
        if (has(history.channels, driving)) sum += integral(history, driving, "", every);
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
        const double pitching = end.state_supply - end.state_dissipation, work = recorded_work(history, 1);
        const double error = (end.loads - pitching - work) / scale, allowed = a.run.step / 4;
        // Of an oscillation that the outputs do not resolve trapezoids say nothing.
        if (std::abs(error) > allowed && std::abs(work - recorded_work(history, 2)) > allowed * scale)
            std::printf("recorded power of %s: outputs every %g s are too far apart to check it by its work; --step\n",
                        loads.c_str(), a.run.step);
        else
            good =
                check(text("recorded power of ", loads, " against its work, likewise").c_str(), error, allowed) && good;
    }
    return good;
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
