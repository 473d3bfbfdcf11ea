// Channels of time histories: over time, their spectra, energies.
#include "programs/cardan/plot_histories.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/channel_choice.hpp"
#include "programs/shared/history_parts.hpp"
#include "solvers/hdf5/history.hpp"
#include "solvers/signals/sampling.hpp"
#include "turbines/tables/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <numeric>
#include <span>
#include <string_view>

namespace cardan::program {

namespace {

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

using Histories = std::vector<solvers::NamedHistory>;

// Names of the channels asked for that any of the histories has, each once, in the order of the patterns.
std::vector<std::string> chosen(const Histories& histories, const std::vector<std::string>& patterns) {
    std::vector<std::string> names;
    for (const std::string& pattern : patterns) {
        bool any = false;
        for (const auto& [name, history] : histories)
            for (const Channel& channel : history->channels) {
                if (!matches(pattern, channel.name) && (channel.alias.empty() || !matches(pattern, channel.alias)))
                    continue;
                any = true;
                if (std::find(names.begin(), names.end(), channel.name) == names.end()) names.push_back(channel.name);
            }
        if (!any && pattern.find('*') == std::string::npos)
            static_cast<void>(histories.front().history->index(pattern));  // says what is
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

// To put behind a number.
std::string unit(const solvers::ShownUnits& shown) {
    return shown.units == "1" ? "" : text(" ", solvers::display_text(shown.units));
}

// Where none is asked for: what there is of speeds, deflections and loads, else the first ones.
std::vector<std::string> usual(const Histories& histories) {
    constexpr std::size_t first = 6;
    std::vector<std::string> names;
    for (const char* name :
         {"wind speed", "rotor speed", "generator torque", "blade 1 pitch angle", "tower top fore-aft displacement",
          "tower base moment y", "blade 1 tip out-of-plane deflection", "blade 1 root moment y"})
        for (const auto& [file, history] : histories) {
            if (!has(history->channels, name)) continue;
            names.push_back(history->channels[history->index(name)].name);
            break;
        }
    const std::vector<Channel>& all = histories.front().history->channels;
    if (names.empty())
        for (std::size_t i = 0; i < std::min(first, all.size()); ++i) names.push_back(all[i].name);
    if (names.empty()) throw InputError("--channel", "channels of the history", 0, "at least one");
    std::cout << "the usual channels; --list shows all, --channel draws others\n";
    return names;
}

// "A: rotor speed", of one history "rotor speed".
std::string with_file(const std::string& channel, const std::string& history, const Histories& histories) {
    return histories.size() > 1 ? text(history, ": ", channel) : channel;
}

void print_values(const Histories& histories, const std::vector<std::string>& names, const PlotArguments& a) {
    const auto angles = a.degrees ? solvers::AngleUnits::degrees : solvers::AngleUnits::radians;
    for (const std::string& name : names)
        for (const auto& [file, history] : histories) {
            if (!has(history->channels, name)) continue;
            const solvers::SampleRange range = solvers::samples_between(history->time, a.from, a.to);
            const std::size_t i = history->index(name);
            const auto values = std::span(history->values[i]).subspan(range.first, range.count);
            const auto ends = std::minmax_element(values.begin(), values.end());
            const solvers::ShownUnits shown = solvers::shown_units(history->channels[i], angles);
            const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
            std::cout << "  " << with_file(name, file, histories) << ": " << shown.factor * *ends.first << " to "
                      << shown.factor * *ends.second << unit(shown) << ", mean of the samples " << shown.factor * mean
                      << unit(shown) << "\n";
        }
}

void print_peaks(const Histories& histories, const std::vector<std::string>& names, const PlotArguments& a,
                 const solvers::SpectrumPlotOptions& options) {
    for (const std::string& name : names)
        for (const auto& [file, history] : histories) {
            if (!has(history->channels, name)) continue;
            const solvers::Spectrum s = solvers::spectrum(*history, name, options.spectrum);
            const solvers::ShownUnits shown =
                solvers::shown_units(history->channels[history->index(name)], options.angles);
            std::cout << "  " << with_file(name, file, histories) << ": peaks";
            const std::vector<solvers::Peak> found = solvers::peaks(s, 5);
            if (found.empty()) std::cout << ": none";
            for (const solvers::Peak& peak : found) {
                std::cout << (&peak == found.data() ? " " : ", ") << peak.frequency << " Hz";
                if (a.rpm > 0)
                    std::cout << " = " << std::setprecision(3) << peak.frequency * units::minute / a.rpm << "P";
                std::cout << std::setprecision(4) << " (" << shown.factor * peak.amplitude << unit(shown) << ")";
            }
            std::cout << "\n";
        }
}

// Those of the channels that there are, alone, in equal steps.
solvers::History sampled_evenly(const solvers::NamedHistory& one, const std::vector<std::string>& names) {
    const solvers::TimeSteps steps = solvers::time_steps(one.history->time);
    if (!steps.uniform())
        std::cout << one.name << ": the steps between samples are not equal: resampled every " << steps.median
                  << " s by cubic pieces for the spectra\n";
    std::vector<std::string> own = names;
    std::erase_if(own, [&](const std::string& name) { return !has(one.history->channels, name); });
    return in_equal_steps(part_of(*one.history, own));
}

void draw_spectra(const Histories& histories, const std::vector<std::string>& names,
                  const std::vector<solvers::HistoryPanel>& panels, const PlotArguments& a) {
    std::vector<solvers::History> samples;
    samples.reserve(histories.size());
    Histories even;
    for (const solvers::NamedHistory& one : histories)
        even.push_back({one.name, &samples.emplace_back(sampled_evenly(one, names))});
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
    const auto with_any = std::ranges::find_if(samples, [](const solvers::History& h) { return !h.channels.empty(); });
    const solvers::Spectrum first = solvers::spectrum(*with_any, with_any->channels.front().name, options.spectrum);
    draw_files(a, "_spectrum",
               text(a.density ? "power spectral densities" : "amplitude spectra", ", ", first.segments, " segment",
                    first.segments == 1 ? "" : "s", " of ", 1 / first.step, " s"),
               [&](const std::string& path) { solvers::plot_spectra(even, panels, path, options); });
    print_peaks(even, names, a, options);
}

// Of the same units, whichever history has them.
std::vector<solvers::HistoryPanel> together(const Histories& histories, const std::vector<std::string>& names,
                                            solvers::AngleUnits angles) {
    solvers::History all;
    for (const auto& [name, history] : histories)
        for (const Channel& channel : history->channels)
            if (!has(all.channels, channel.name)) all.channels.push_back(channel);
    return solvers::panels_by_units(all, names, angles);
}

}  // namespace

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

int draw_histories(const PlotArguments& a, const std::vector<std::string>& names_of_files) {
    std::vector<solvers::History> loaded;
    loaded.reserve(a.files.size());
    Histories histories;
    for (std::size_t i = 0; i < a.files.size(); ++i)
        histories.push_back({names_of_files[i], &loaded.emplace_back(load(a.files[i]))});
    std::cout << std::setprecision(4);
    if (a.list) {
        for (const solvers::History& history : loaded) print_list(history);
        return 0;
    }
    std::vector<std::string> names = chosen(histories, a.channels);
    if (names.empty() && !a.energy) names = usual(histories);
    if (a.energy && histories.size() > 1) throw InputError("--energy", "number of histories", histories.size(), "1");
    solvers::HistoryPlotOptions options;
    options.title = a.title;
    options.from = a.from;
    options.to = a.to;
    options.angles = a.degrees ? solvers::AngleUnits::degrees : solvers::AngleUnits::radians;
    options.marks = marks(a.marks);
    if (!names.empty()) {
        const std::vector<solvers::HistoryPanel> panels =
            a.together ? together(histories, names, options.angles) : solvers::one_panel_each(names);
        draw_files(a, "",
                   text(names.size(), " channel", names.size() == 1 ? "" : "s", " in ", panels.size(), " panel",
                        panels.size() == 1 ? "" : "s"),
                   [&](const std::string& path) { solvers::plot(histories, panels, path, options); });
        print_values(histories, names, a);
        if (a.spectrum) draw_spectra(histories, names, panels, a);
    }
    if (a.energy)
        draw_files(a, "_energy", "energies and their error",
                   [&](const std::string& path) { solvers::plot_energies(loaded.front(), path, options); });
    return 0;
}

}  // namespace cardan::program
