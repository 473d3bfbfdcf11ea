// Motion of any machine in time, from a start in steady rotation or at rest.
//
// Problem: a machine (built in, or a file of OpenFAST, windIO or our own) starts at a rotor speed in its steady state
// under gravity, periodic where it is: two blades, unequal blades, gravity itself. From there its equations of motion
// are integrated with the rotor free, against a constant torque of the generator or one that rises with its speed, or
// driven at constant speed; or under a controller, which sets pitch and torque of the generator. Coordinates may start
// elsewhere, to see their motion decay. What drives the rotor is the air, steady or over time, or a given torque.
// Checks: the energy balance, by the integration and by the recorded powers of generator, air and rotor torque.
#include "programs/cardan/commands.hpp"
#include "programs/cardan/options.hpp"
#include "programs/cardan/simulate_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace cardan::program {

namespace {

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
        const auto usual =
            a.controller.what == "none" ? usual_panels(layout, channels) : controlled_panels(layout, channels);
        return a.wind == "none" ? usual : with_air(usual);
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

// Of the loads that are recorded, J; positive: put into the machine. From each so many-th sample.
double recorded_work(const solvers::History& history, std::size_t every) {
    double sum = 0;
    if (has(history.channels, "generator power")) sum -= integral(history, "generator power", "", every);
    for (const char* driving : {"rotor torque power", "work rate of the air"})
        if (has(history.channels, driving)) sum += integral(history, driving, "", every);
    return sum;
}

constexpr std::array loads{std::pair("generator power", "generator"), std::pair("rotor torque power", "rotor torque"),
                           std::pair("work rate of the air", "air")};

// What is printed, checked and drawn: of a long run all channels may not fit into memory.
std::vector<std::string> needed(const turbines::MachineLayout& layout, const std::vector<Channel>& channels,
                                std::initializer_list<std::vector<solvers::HistoryPanel>> pictures) {
    std::vector<std::string> names = main_channels(layout, channels);
    names.emplace_back("RotSpeed");
    names.insert(names.end(), solvers::energy_channels.begin(), solvers::energy_channels.end());
    for (const auto& [channel, name] : loads) names.emplace_back(channel);
    for (const std::vector<solvers::HistoryPanel>& panels : pictures)
        for (const solvers::HistoryPanel& panel : panels)
            names.insert(names.end(), panel.channels.begin(), panel.channels.end());
    std::erase_if(names, [&](const std::string& name) { return !has(channels, name); });
    return names;
}

bool check_balance(const turbines::Recording& run, const SimulateArguments& a) {
    const solvers::History& history = run.history;
    const solvers::EnergyBalance& end = run.energy;
    const double kinetic = largest(history, "kinetic energy").value;
    const double exchanged = exchanged_energy(history);
    const bool parked = exchanged > kinetic;
    const double scale = parked ? exchanged : kinetic;
    std::printf("\n");
    bool good = check_energy(end, scale, 10 * a.run.tolerance, parked);
    std::string acting;
    for (const auto& [channel, name] : loads)
        if (has(history.channels, channel)) acting += text(acting.empty() ? "" : ", ", name);
    if (!acting.empty() && history.time.size() > 1) {
        // What pitch drives do counts as a load as well.
        const double pitching = end.state_supply - end.state_dissipation, work = recorded_work(history, 1);
        const double error = (end.loads - pitching - work) / scale, allowed = a.run.step / 4;
        // Of an oscillation that the outputs do not resolve trapezoids say nothing.
        if (std::abs(error) > allowed && std::abs(work - recorded_work(history, 2)) > allowed * scale)
            std::printf("recorded power of %s: outputs every %g s are too far apart to check it by its work; --step\n",
                        acting.c_str(), a.run.step);
        else
            good = check(text("recorded power of ", acting, " against its work, likewise").c_str(), error, allowed) &&
                   good;
    }
    return good;
}

void print_result(const turbines::Simulation& run, const SimulateArguments& a, const solvers::History& history) {
    std::printf("%s: from %g rpm, rotor %s, %g s\n", run.title().c_str(), *a.rpm,
                dofs_of(run.machine().description).generator ? "free" : "driven", run.integrator().time());
    const std::vector<std::string> names = main_channels(run.turbine().layout(), history.channels);
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

turbines::Simulation simulation(SimulateArguments& a, const turbines::SimulationSettings& settings,
                                const turbines::Machine& machine) {
    turbines::Simulation run(machine, settings);
    keep_taken(run.settings(), a);
    if (a.machine.summary) std::cout << run.turbine().summary() << "\n";
    return run;
}

int run(SimulateArguments& a, const CommandLine& command) {
    if (a.duration) a.run.duration = *a.duration;
    check_run_options(a.run);
    a.machine.gravity = !a.no_gravity;
    if (a.run.out.empty()) a.run.out = default_prefix(a.machine.model, "history");
    const turbines::SimulationSettings settings = settings_of(a);
    const bool begun = a.run.resume && std::filesystem::exists(a.run.out + ".h5");
    if (!begun && !a.list) check_outputs(a.run.out, run_outputs, {a.machine.model, a.wind});
    turbines::Machine machine = prepared_machine(a.machine);
    check_stations(machine, a.machine, a.stations);
    if (a.rated_power) machine.operation.rated_power = *a.rated_power * 1e3;
    const bool in_air = a.wind.empty() ? machine.run && machine.run->air : a.wind != "none";
    // Air of the model's own run that it cannot have is the library's to refuse.
    if (in_air && (machine.air || !a.air.file.empty() || !a.wind.empty())) take_air(machine, a.air, a.machine);
    turbines::Simulation simulated = simulation(a, settings, machine);
    if (a.list) return print(simulated.channels()), 0;
    const turbines::MachineLayout& layout = simulated.turbine().layout();
    const std::vector<solvers::HistoryPanel> pictures = panels(a, layout, simulated.channels()),
                                             spectra = spectra_of(layout);

    const double duration = simulated.duration({.duration = a.duration});
    const Stopwatch watch;
    const turbines::Recording result =
        simulated.record(a.run.out + ".h5", {.duration = a.duration,
                                             .step = a.run.step,
                                             .resume = a.run.resume,
                                             .origin = run_text("simulate", command),
                                             .kept = needed(layout, simulated.channels(), {pictures, spectra}),
                                             .progress = TimeShown(duration)});
    const Elapsed elapsed = watch.elapsed();
    progress("\r                              \r");

    print_result(simulated, a, result.history);
    const bool good = check_balance(result, a);
    print_effort(simulated.integrator(), simulated.turbine().system(), elapsed);
    write_pictures(result.history, simulated.channels().size(), a.run.out, pictures, spectra,
                   {.from = simulated.integrator().time() / 2,
                    .blades = static_cast<int>(layout.blades.size()),
                    .max_frequency_hz = 8});
    if (!result.complete) return 130;
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
