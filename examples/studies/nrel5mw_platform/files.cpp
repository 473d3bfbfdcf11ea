#include "examples/studies/nrel5mw_platform/files.hpp"

#include "mbs/base/pending_file.hpp"
#include "programs/shared/simulation.hpp"
#include "solvers/time/recorder.hpp"
#include "turbines/model/channels.hpp"

#include <iomanip>
#include <sstream>
#include <utility>

namespace cardan::platform {

namespace {

const std::vector<std::string> energies(solvers::energy_channels.begin(), solvers::energy_channels.end());

// Positions; those of driven coordinates are among drive_channels().
ChannelGroup free_coordinates(const CoordinateTable& table) {
    ChannelGroup group;
    for (const int a : table.free())
        group.channels.push_back({.name = table[a].name,
                                  .units = table[a].unit,
                                  .long_name = text("position of the coordinate '", table[a].name, "'")});
    group.sample = [free = table.free()](const DynamicView& at, double* values) {
        for (const int a : free) *values++ = at.q(a);
    };
    return group;
}

// The blades' channels of one kind, e.g. "root My".
std::vector<std::string> of_blades(const turbines::Turbine& machine, const char* what) {
    std::vector<std::string> names;
    for (std::size_t k = 1; k <= machine.layout().blades.size(); ++k) names.push_back(text("blade ", k, " ", what));
    return names;
}

// Platform and nacelle, as far as they move.
std::vector<std::string> motions(const turbines::Turbine& machine, const solvers::History& history) {
    const Model& model = machine.system().model;
    std::vector<BodyId> bodies(machine.layout().platform->coordinates.begin(),
                               machine.layout().platform->coordinates.end());
    bodies.push_back(*machine.layout().yaw);
    std::vector<std::string> moving;
    for (const BodyId body : bodies) {
        const std::string& name = model.coordinates()[model.index(body)].name;
        const auto [min, max] = std::ranges::minmax(history[name]);
        if (min < max) moving.push_back(name);
    }
    return moving;
}

std::vector<std::string> names_of(const ChannelGroup& group) {
    std::vector<std::string> names;
    for (const Channel& channel : group.channels) names.push_back(channel.name);
    return names;
}

// Everything but the free coordinates and the counters of the integration.
std::vector<std::string> table_channels(const turbines::Turbine& machine) {
    std::vector<std::string> names = energies;
    for (const ChannelGroup& group : {turbines::blade_channels(machine), turbines::drive_channels(machine)})
        for (const std::string& name : names_of(group)) names.push_back(name);
    return names;
}

void draw_last_periods(const turbines::Turbine& machine, const solvers::History& history, const std::string& prefix) {
    std::vector<solvers::HistoryPanel> panels = solvers::one_panel_each(motions(machine, history));
    for (const char* what : {"tip flap deflection", "tip edge deflection", "root My", "root Mz"})
        panels.push_back({of_blades(machine, what)});
    for (const char* ending : {".svg", ".png"}) solvers::plot(history, panels, prefix + ending);
}

}  // namespace

std::vector<ChannelGroup> recorded_channels(const turbines::Turbine& machine) {
    std::vector<ChannelGroup> groups{turbines::blade_channels(machine), turbines::drive_channels(machine),
                                     free_coordinates(machine.system().model.coordinates())};
    // Rotor, platform and tower under OpenFAST's names; the blades have their own here.
    for (ChannelGroup& group : turbines::channels(machine))
        if (!group.channels.front().name.starts_with("blade ")) groups.push_back(std::move(group));
    return groups;
}

solvers::RecorderOptions recorder_options() {
    return {.coordinates = false, .rates = false, .accelerations = false, .actuators = false};
}

std::vector<std::string> tip_deflections(const turbines::Turbine& machine) {
    std::vector<std::string> names;
    for (const Channel& channel : turbines::blade_channels(machine).channels)
        if (channel.units == "m") names.push_back(channel.name);
    return names;
}

void write_csv(const turbines::Turbine& machine, const solvers::History& period, const std::string& path) {
    const solvers::History table = program::part_of(period, table_channels(machine));
    std::ostringstream out = text_stream();
    out << std::setprecision(12) << "time[s]";
    for (const Channel& channel : table.channels) out << "," << channel.name << "[" << channel.units << "]";
    for (std::size_t i = 0; i < table.time.size(); ++i) {
        out << "\n" << table.time[i];
        for (const std::vector<double>& values : table.values) out << "," << values[i];
    }
    out << "\n";
    write_file(path, out.str());
}

Drawn draw_pictures(const turbines::Turbine& machine, const std::string& prefix, const PictureOptions& options) {
    const std::string file = prefix + ".h5";
    const solvers::History balance = solvers::read_history(file, {.channels = energies});
    if (balance.time.size() < 2) return {};
    Drawn drawn{program::largest(balance, energies.front()).value, program::exchanged_energy(balance),
                ", .svg, .png, _energy.png"};
    solvers::plot_energies(balance, prefix + "_energy.png");
    const double rounding = 1e-9 * options.period;
    const auto part = [&](double from, double to) {
        return solvers::read_history(
            file, {.channels = table_channels(machine), .from = from - rounding, .to = to + rounding});
    };
    const double end = balance.time.back();
    draw_last_periods(machine, part(std::max(end - 3 * options.period, balance.time.front()), end), prefix);
    const solvers::History periodic = part(options.periodic_to - 10 * options.period, options.periodic_to);
    const std::vector<solvers::HistoryPanel> spectra{{{"blade 1 tip flap deflection", "blade 1 tip edge deflection"}},
                                                     {{"blade 1 root My", "blade 1 root Mz"}}};
    if (program::plot_spectra(periodic, spectra, prefix + "_spectrum.png",
                              {.rotor_speed = options.rotor_speed,
                               .tell_speed = false,
                               .blades = static_cast<int>(machine.layout().blades.size()),
                               .max_frequency_hz = std::max(1.5, 6 / options.period)}))
        drawn.files += ", _spectrum.png";
    return drawn;
}

}  // namespace cardan::platform
