// Pictures of a recorded motion: channels over time, their spectra, where the energy is; of a Campbell diagram.
//
// Reads histories in HDF5, and tables whose first column is the time: time[s],blade 1 tip flap deflection[m],rotor
// speed[rad s-1] ...
#include "mbs/base/error.hpp"
#include "mbs/base/types.hpp"
#include "mbs/base/units.hpp"
#include "solvers/hdf5/campbell.hpp"
#include "solvers/hdf5/history.hpp"
#include "solvers/pictures/campbell.hpp"
#include "solvers/pictures/history.hpp"
#include "solvers/signals/sampling.hpp"
#include "turbines/machine/result.hpp"
#include "turbines/tables/csv.hpp"

#include "programs/cardan/commands.hpp"
#include "programs/cardan/operation.hpp"
#include "programs/shared/history_parts.hpp"
#include "programs/shared/program.hpp"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <numeric>

namespace cardan::program {

namespace {

struct PlotArguments {
    std::string file, out, title;
    std::vector<std::string> channels, marks, formats{"svg", "png"};
    bool list = false, energy = false, spectrum = false, density = false, together = false, degrees = true;
    bool linear_trend = false;
    double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
    double segment = 0, max_frequency = 0, rpm = 0;
    int blades = 3;
};

void declare(CommandLine& app, PlotArguments& a) {
    app.add_option("file", a.file, "history or Campbell diagram .h5, or table .csv: time[s],NAME[UNIT],...").required();
    app.add_option("--channel", a.channels, "name or alias; * stands for any text; may be repeated").one_word();
    app.add_flag("--list", a.list, "print the channels and end");
    app.add_option("--out", a.out, "prefix of the files (default: name of the file, in the current folder)");
    app.add_option("--format", a.formats, "kinds of pictures, comma-separated")
        .delimiter(',')
        .one_of({"svg", "png", "pdf"});
    app.add_option("--title", a.title, "heading (default: that of the history)");
    app.add_option("--from", a.from, "leave out what was before, s").hide_default();
    app.add_option("--to", a.to, "leave out what was after, s").hide_default();
    app.add_option("--mark", a.marks, "vertical line TIME=LABEL, s; may be repeated").one_word();
    app.add_flag("--together", a.together, "channels with the same units share a panel");
    app.add_flag("--degrees,!--radians", a.degrees,
                 "angles in deg, rates in deg/s, speeds in rpm (this is the default), or in rad and rad/s");
    app.add_flag("--energy", a.energy, "energies and their error, from the channels of the recorder");
    app.add_flag("--spectrum", a.spectrum, "amplitude spectra of the channels (Hann window), and their peaks");
    app.add_flag("--density", a.density, "power spectral densities instead of amplitudes");
    app.add_option("--segment", a.segment, "average over segments of this length, s (default: all in one)")
        .hide_default();
    app.add_flag("--linear-trend", a.linear_trend, "take a line from the segments, not only the mean");
    app.add_option("--max-frequency", a.max_frequency,
                   "end of the spectra, Hz (default: half the sampling frequency), or of the diagram")
        .hide_default();
    app.add_option("--rpm", a.rpm, "rotor speed: lines at its multiples nP, rev/min").hide_default();
    app.add_option("--blades", a.blades, "number of blades, for nP");
}

// The first column is the time; names and units are those of the header.
solvers::History read_csv(const std::filesystem::path& path) {
    const turbines::CsvTable table = turbines::CsvTable::read(path);
    const std::vector<std::string> names = table.names();
    if (table.unit(names[0]) != "s")
        throw InputError(path.string(), "first column", text(names[0], "[", table.unit(names[0]), "]"), "time[s]");
    solvers::History history;
    history.title = path.stem().string();
    for (const std::string& name : names) {
        const std::span<const double> column = table.column(name);
        std::vector<double> values(column.begin(), column.end());
        if (name == names[0]) {
            history.time = std::move(values);
            continue;
        }
        const std::string& unit = table.unit(name);
        history.channels.push_back({.name = name, .units = unit == "-" ? "1" : unit, .long_name = name});
        history.values.push_back(std::move(values));
    }
    return history;
}

// Every kind of file that can be read.
solvers::History load(const std::filesystem::path& path) {
    if (path.extension() == ".csv") return read_csv(path);
    if (path.extension() == ".h5") return solvers::read_history(path);
    throw FileError(path.string(), "a history ends in .h5 or .csv");
}

// Does the name match the pattern, in which * stands for any text?
bool matches(std::string_view pattern, std::string_view name) {
    const std::size_t star = pattern.find('*');
    if (star == std::string_view::npos) return pattern == name;
    if (!name.starts_with(pattern.substr(0, star))) return false;
    const std::string_view rest = pattern.substr(star + 1);
    for (std::size_t skip = star; skip <= name.size(); ++skip)
        if (matches(rest, name.substr(skip))) return true;
    return false;
}

// Names of the channels asked for, each once, in the order of the patterns.
std::vector<std::string> chosen(const solvers::History& history, const std::vector<std::string>& patterns) {
    std::vector<std::string> names;
    for (const std::string& pattern : patterns) {
        bool any = false;
        for (const Channel& channel : history.channels) {
            if (!matches(pattern, channel.name) && (channel.alias.empty() || !matches(pattern, channel.alias)))
                continue;
            any = true;
            if (std::find(names.begin(), names.end(), channel.name) == names.end()) names.push_back(channel.name);
        }
        if (!any && pattern.find('*') == std::string::npos) static_cast<void>(history.index(pattern));  // says what is
        if (!any) throw InputError("--channel", "name", pattern, "one that matches a channel; --list shows them");
    }
    return names;
}

void print_list(const solvers::History& history) {
    std::cout << history.channels.size() << " channels, " << history.time.size() << " samples";
    if (!history.time.empty()) std::cout << " from " << history.time.front() << " to " << history.time.back() << " s";
    std::cout << "\n";
    for (const Channel& channel : history.channels) {
        std::cout << "  " << channel.name << " [" << channel.units << "]";
        if (!channel.alias.empty()) std::cout << " (" << channel.alias << ")";
        if (channel.long_name != channel.name) std::cout << ": " << channel.long_name;
        std::cout << "\n";
    }
}

void print_branches(const solvers::Campbell& diagram) {
    std::cout << diagram.branches.size() << " modes at " << diagram.points.size() << " rotor speeds\n";
    for (const solvers::Branch& branch : diagram.branches) std::cout << "  " << branch.name << "\n";
}

std::vector<solvers::HistoryMark> marks(const std::vector<std::string>& given) {
    std::vector<solvers::HistoryMark> all;
    for (const std::string& mark : given) {
        const std::size_t equals = std::min(mark.find('='), mark.size());
        double time = 0;
        const auto [end, error] = std::from_chars(mark.data(), mark.data() + equals, time);
        if (equals == mark.size() || error != std::errc() || end != mark.data() + equals || !std::isfinite(time))
            throw InputError("--mark", "value", mark, "TIME=LABEL, s");
        all.push_back({time, mark.substr(equals + 1)});
    }
    return all;
}

// The pictures PREFIX.svg, PREFIX.png ...; says what is in them.
template <class Draw>
void draw(const PlotArguments& a, const std::string& suffix, const std::string& what, const Draw& picture) {
    std::string files;
    for (const std::string& format : a.formats) {
        const std::string path = text(a.out, suffix, ".", format);
        picture(path);
        files += (files.empty() ? "" : ", ") + path;
    }
    std::cout << files << ": " << what << "\n";
}

// To put behind a number.
std::string unit(const solvers::ShownUnits& shown) {
    return shown.units == "1" ? "" : text(" ", solvers::display_text(shown.units));
}

void print_values(const solvers::History& history, const std::vector<std::string>& names, const PlotArguments& a) {
    const auto angles = a.degrees ? solvers::AngleUnits::degrees : solvers::AngleUnits::radians;
    const solvers::SampleRange range = solvers::samples_between(history.time, a.from, a.to);
    for (const std::string& name : names) {
        const std::size_t i = history.index(name);
        const auto values = std::span(history.values[i]).subspan(range.first, range.count);
        const auto ends = std::minmax_element(values.begin(), values.end());
        const solvers::ShownUnits shown = solvers::shown_units(history.channels[i], angles);
        const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
        std::cout << "  " << name << ": " << shown.factor * *ends.first << " to " << shown.factor * *ends.second
                  << unit(shown) << ", mean of the samples " << shown.factor * mean << unit(shown) << "\n";
    }
}

void print_peaks(const solvers::History& history, const std::vector<std::string>& names, const PlotArguments& a,
                 const solvers::SpectrumPlotOptions& options) {
    for (const std::string& name : names) {
        const solvers::Spectrum s = solvers::spectrum(history, name, options.spectrum);
        const solvers::ShownUnits shown = solvers::shown_units(history.channels[history.index(name)], options.angles);
        std::cout << "  " << name << ": peaks";
        const std::vector<solvers::Peak> found = solvers::peaks(s, 5);
        if (found.empty()) std::cout << ": none";
        for (const solvers::Peak& peak : found) {
            std::cout << (&peak == found.data() ? " " : ", ") << peak.frequency << " Hz";
            if (a.rpm > 0) std::cout << " = " << std::setprecision(3) << peak.frequency * units::minute / a.rpm << "P";
            std::cout << std::setprecision(4) << " (" << shown.factor * peak.amplitude << unit(shown) << ")";
        }
        std::cout << "\n";
    }
}

// The channels alone, in equal steps.
solvers::History sampled_evenly(const solvers::History& history, const std::vector<std::string>& names) {
    const solvers::TimeSteps steps = solvers::time_steps(history.time);
    if (!steps.uniform())
        std::cout << "the steps between samples are not equal: resampled every " << steps.median
                  << " s by cubic pieces for the spectra\n";
    return in_equal_steps(part_of(history, names));
}

void draw_spectra(const solvers::History& history, const std::vector<std::string>& names,
                  const std::vector<solvers::HistoryPanel>& panels, const PlotArguments& a) {
    const solvers::History even = sampled_evenly(history, names);
    solvers::SpectrumPlotOptions options;
    options.title = a.title;
    options.angles = a.degrees ? solvers::AngleUnits::degrees : solvers::AngleUnits::radians;
    options.spectrum.segment = a.segment;
    options.spectrum.detrend = a.linear_trend ? solvers::Detrend::linear : solvers::Detrend::mean;
    options.spectrum.from = a.from;
    options.spectrum.to = a.to;
    options.density = a.density;
    options.max_frequency_hz = a.max_frequency;
    options.rotor_frequency_hz = a.rpm / units::minute;
    options.blades = a.blades;
    const solvers::Spectrum first = solvers::spectrum(even, names.front(), options.spectrum);
    draw(a, "_spectrum",
         text(a.density ? "power spectral densities" : "amplitude spectra", ", ", first.segments, " segment",
              first.segments == 1 ? "" : "s", " of ", 1 / first.step, " s"),
         [&](const std::string& path) { solvers::plot_spectra(even, panels, path, options); });
    print_peaks(even, names, a, options);
}

// A Campbell diagram once more, with another limit, title or format.
int draw_diagram(const PlotArguments& a) {
    const solvers::Campbell diagram = solvers::read_campbell(a.file);
    if (a.list) return print_branches(diagram), 0;
    check_outputs(a.out, {".svg"});
    solvers::CampbellPlotOptions options;
    options.max_frequency_hz = a.max_frequency;
    options.title = a.title.empty() ? title_of(diagram) : a.title;
    if (!diagram.warning.empty()) std::cout << "warning: " << diagram.warning << "\n";
    draw(a, "", text("Campbell diagram, ", diagram.branches.size(), " modes"),
         [&](const std::string& path) { solvers::plot(diagram, path, options); });
    return 0;
}

int run(PlotArguments& a, const CommandLine& /*command*/) {
    require_not_negative("--rpm", "value", a.rpm);
    if (a.out.empty()) a.out = std::filesystem::path(a.file).stem().string();
    a.spectrum = a.spectrum || a.density;
    if (turbines::is_result(a.file) && !turbines::is_history(a.file)) return draw_diagram(a);
    const solvers::History history = load(a.file);
    std::cout << std::setprecision(4);
    if (a.list) {
        print_list(history);
        return 0;
    }
    const std::vector<std::string> names = chosen(history, a.channels);
    if (names.empty() && !a.energy)
        throw InputError("--channel", "channels", "none", "at least one, or --energy; --list shows them");
    check_outputs(a.out, {".svg"});
    solvers::HistoryPlotOptions options;
    options.title = a.title;
    options.from = a.from;
    options.to = a.to;
    options.angles = a.degrees ? solvers::AngleUnits::degrees : solvers::AngleUnits::radians;
    options.marks = marks(a.marks);
    if (!names.empty()) {
        const std::vector<solvers::HistoryPanel> panels =
            a.together ? solvers::panels_by_units(history, names, options.angles) : solvers::one_panel_each(names);
        draw(a, "",
             text(names.size(), " channel", names.size() == 1 ? "" : "s", " in ", panels.size(), " panel",
                  panels.size() == 1 ? "" : "s"),
             [&](const std::string& path) { solvers::plot(history, panels, path, options); });
        print_values(history, names, a);
        if (a.spectrum) draw_spectra(history, names, panels, a);
    }
    if (a.energy)
        draw(a, "_energy", "energies and their error",
             [&](const std::string& path) { solvers::plot_energies(history, path, options); });
    return 0;
}

}  // namespace

int plot_command(int argc, char** argv) {
    return run_command<PlotArguments>(
        "cardan plot",
        "Pictures of a recorded motion, or of a Campbell diagram.\n"
        "Writes PREFIX.svg and .png with the channels over time, PREFIX_spectrum.* with --spectrum or --density, and "
        "PREFIX_energy.* with --energy.",
        argc, argv, declare, run);
}

}  // namespace cardan::program
