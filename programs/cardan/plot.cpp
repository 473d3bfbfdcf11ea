// Pictures of a recorded motion: channels over time, their spectra, where the energy is; of a Campbell diagram; of
// operating points over the wind. Several results of one kind are drawn over each other.
//
// Reads histories in HDF5, and tables whose first column is the time: time[s],blade 1 tip flap deflection[m],rotor
// speed[rad s-1] ...
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "programs/cardan/commands.hpp"
#include "programs/cardan/options.hpp"
#include "programs/cardan/plot_histories.hpp"
#include "programs/cardan/wind_curves.hpp"
#include "programs/shared/program.hpp"
#include "solvers/hdf5/campbell.hpp"
#include "solvers/pictures/campbell.hpp"
#include "turbines/machine/result.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>

namespace cardan::program {

namespace {

void declare(CommandLine& app, PlotArguments& a) {
    app.add_option("file", a.files,
                   "history, Campbell diagram or operating points over the wind .h5, or table .csv: "
                   "time[s],NAME[UNIT],...; several of one kind: over each other")
        .required();
    app.add_option("--channel", a.channels,
                   "name or alias; * stands for any text; may be repeated (default: speeds, deflections and loads)")
        .one_word();
    app.add_flag("--list", a.list, "print the channels and end");
    app.add_option("--out", a.out,
                   "prefix of the files (default: names of the files, joined by _and_, in the current folder)");
    app.add_option("--format", a.formats, "kinds of pictures, comma-separated")
        .delimiter(',')
        .one_of({"svg", "png", "pdf"});
    app.add_option("--title", a.title, "heading (default: that of the history)");
    app.add_option("--from", a.from, "leave out what was before, s").hide_default().finite();
    app.add_option("--to", a.to, "leave out what was after, s").hide_default().finite();
    app.add_option("--mark", a.marks, "vertical line TIME=LABEL, s; may be repeated").one_word();
    app.add_flag("--together", a.together, "channels with the same units share a panel");
    app.add_flag("--degrees,!--radians", a.degrees,
                 "angles in deg, rates in deg/s, speeds in rpm (this is the default), or in rad and rad/s");
    app.add_flag("--energy", a.energy, "energies and their error, from the channels of the recorder");
    app.add_flag("--spectrum", a.spectrum, "amplitude spectra of the channels (Hann window), and their peaks");
    app.add_flag("--density", a.density, "power spectral densities instead of amplitudes");
    app.add_option("--segment", a.segment, "average over segments of this length, s (default: all in one)")
        .hide_default()
        .not_negative();
    app.add_flag("--linear-trend", a.linear_trend, "take a line from the segments, not only the mean");
    app.add_option("--max-frequency", a.max_frequency,
                   "end of the spectra, Hz (default: half the sampling frequency), or of the diagram")
        .hide_default()
        .not_negative();
    app.add_option("--rpm", a.rpm, "rotor speed: lines at its multiples nP, rev/min").hide_default().not_negative();
    app.add_option("--blades", a.blades, "number of blades, for nP").range(0, 100);
}

void print_branches(const solvers::Campbell& diagram) {
    std::cout << diagram.branches.size() << " modes at " << diagram.points.size()
              << (diagram.parameter.empty() ? " rotor speeds" : text(" values of ", diagram.parameter)) << "\n";
    for (const solvers::Branch& branch : diagram.branches) std::cout << "  " << branch.name << "\n";
}

// Campbell diagrams once more, with another limit, title or format.
int draw_diagrams(const PlotArguments& a, const std::vector<std::string>& names) {
    std::vector<solvers::Campbell> diagrams;
    for (const std::string& file : a.files) diagrams.push_back(solvers::read_campbell(file));
    if (a.list) {
        for (const solvers::Campbell& diagram : diagrams) print_branches(diagram);
        return 0;
    }
    solvers::CampbellPlotOptions options;
    options.max_frequency_hz = a.max_frequency;
    options.title = a.title.empty() ? program::title_of(diagrams.front()) : a.title;
    options.log_damping = !diagrams.front().parameters.empty();
    options.name = names.front();
    for (std::size_t i = 1; i < diagrams.size(); ++i) options.others.push_back({names[i], &diagrams[i]});
    for (std::size_t i = 0; i < diagrams.size(); ++i)
        if (!diagrams[i].warning.empty())
            std::cout << "warning: " << (diagrams.size() > 1 ? names[i] + ": " : "") << diagrams[i].warning << "\n";
    draw_files(a, "", text("Campbell diagram, ", diagrams.front().branches.size(), " modes"),
               [&](const std::string& path) { solvers::plot(diagrams.front(), path, options); });
    return 0;
}

int draw_winds(const PlotArguments& a, const std::vector<std::string>& names) {
    std::vector<WindCurves> curves;
    for (std::size_t i = 0; i < a.files.size(); ++i) curves.push_back(read_wind_curves(a.files[i], names[i]));
    if (a.list) {
        for (const WindCurves& one : curves) {
            std::cout << one.channels.size() << " channels at " << one.winds.size() << " winds from "
                      << one.winds.front() << " to " << one.winds.back() << " m/s\n";
            for (const Channel& channel : one.channels)
                std::cout << "  " << channel.name << " [" << channel.units << "]\n";
        }
        return 0;
    }
    const std::string title = !a.title.empty() ? a.title : curves.front().title;
    draw_files(a, "", text("operating points at ", curves.front().winds.size(), " winds"),
               [&](const std::string& path) { program::draw(curves, a.channels, title, path); });
    return 0;
}

enum class ResultKind : std::uint8_t { history, diagram, winds };

ResultKind kind_of(const std::string& file) {
    if (!turbines::is_result(file) || turbines::is_history(file)) return ResultKind::history;
    return is_wind_result(file) ? ResultKind::winds : ResultKind::diagram;
}

const char* name_of(ResultKind kind) {
    constexpr std::array names{"a history", "a Campbell diagram", "operating points over the wind"};
    return entry(names, kind);
}

// Of what kind all files are.
ResultKind common_kind(const std::vector<std::string>& files) {
    const ResultKind kind = kind_of(files.front());
    for (const std::string& file : files)
        if (kind_of(file) != kind)
            throw InputError(file, "kind", name_of(kind_of(file)), text(name_of(kind), ", as ", files.front()));
    return kind;
}

// Without folder and ending, where that tells them apart.
std::vector<std::string> short_names(const std::vector<std::string>& files) {
    std::vector<std::string> names;
    for (const std::string& file : files) {
        std::string stem = std::filesystem::path(file).stem().string();
        if (std::ranges::find(names, stem) != names.end()) return files;
        names.push_back(std::move(stem));
    }
    return names;
}

int run(PlotArguments& a, const CommandLine& /*command*/) {
    const std::vector<std::string> names = short_names(a.files);
    if (a.out.empty())
        for (const std::string& file : a.files)
            a.out += (a.out.empty() ? "" : "_and_") + std::filesystem::path(file).stem().string();
    static_cast<void>(marks(a.marks));
    a.spectrum = a.spectrum || a.density;
    if (!a.list) check_outputs(a.out, {".svg"});
    const ResultKind kind = common_kind(a.files);
    if (kind == ResultKind::diagram) return draw_diagrams(a, names);
    if (kind == ResultKind::winds) return draw_winds(a, names);
    return draw_histories(a, names);
}

}  // namespace

int plot_command(int argc, char** argv) {
    return run_command<PlotArguments>(
        "cardan plot",
        "Pictures of a recorded motion, of a Campbell diagram, or of operating points over the wind; several results "
        "of one kind over each other: cardan plot A.h5 B.h5.\n"
        "Writes PREFIX.svg and .png with the channels over time, PREFIX_spectrum.* with --spectrum or --density, and "
        "PREFIX_energy.* with --energy.",
        argc, argv, declare, run);
}

}  // namespace cardan::program
