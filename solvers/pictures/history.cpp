#include "solvers/pictures/history.hpp"

#include "mbs/base/error.hpp"
#include "solvers/linear/rotor_spin.hpp"
#include "solvers/pictures/gnuplot.hpp"
#include "solvers/pictures/stack.hpp"
#include "solvers/signals/envelope.hpp"
#include "solvers/signals/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cardan::solvers {

namespace {

constexpr double closest_lines = 12;  // pixels

std::string legend(const Channel& channel) {
    std::string name = channel.alias.empty() ? channel.name : text(channel.name, " (", channel.alias, ")");
    if (channel.long_name.empty() || channel.long_name == channel.name) return name;
    return text(name, ": ", channel.long_name);
}

double largest(std::span<const double> values) {
    double size = 0;
    for (double value : values)
        if (std::isfinite(value)) size = std::max(size, std::abs(value));
    return size;
}

// The curves of a panel in the units of the channels, and what they become when they are shown.
struct PanelCurves {
    std::vector<const Channel*> channels;
    std::vector<std::string> labels;
    std::vector<ThinnedCurve> curves;

    // Units after the conversion of angles; all channels must agree.
    std::vector<ShownUnits> units(AngleUnits angles) const {
        std::vector<ShownUnits> all;
        for (const Channel* channel : channels) {
            all.push_back(shown_units(*channel, angles));
            if (all.back().units != all.front().units)
                throw InputError("panel of a picture", text("units of the channel '", channel->name, "'"),
                                 all.back().units, text(all.front().units, ", those of '", channels[0]->name, "'"));
        }
        return all;
    }

    // `exponent`: 2 for densities, which are not given prefixes.
    StackPanel panel(AngleUnits angles, const char* quantity, bool logarithmic, int exponent = 1) {
        const std::vector<ShownUnits> shown = units(angles);
        double size = 0;
        for (std::size_t c = 0; c < curves.size(); ++c) size = std::max(size, shown[c].factor * largest(curves[c].y));
        const ShownUnits scaled =
            exponent == 1 ? with_prefix(shown.front().units, size) : ShownUnits{1, shown.front().units};
        StackPanel panel;
        panel.logarithmic = logarithmic;
        panel.y_label = text(quantity, exponent == 1 ? display_text(scaled.units) : density_text(scaled.units));
        for (std::size_t c = 0; c < curves.size(); ++c) {
            const double factor = std::pow(shown[c].factor * scaled.factor, exponent);
            for (double& y : curves[c].y) y *= factor;
            panel.curves.push_back({labels[c], std::move(curves[c].x), std::move(curves[c].y)});
        }
        return panel;
    }
};

void check_lengths(const History& history) {
    const std::string place = text("history '", history.title, "'");
    if (history.values.size() != history.channels.size())
        throw InputError(place, "rows of values", history.values.size(), text(history.channels.size()));
    for (std::size_t i = 0; i < history.values.size(); ++i)
        if (history.values[i].size() != history.time.size())
            throw InputError(place, text("values of the channel '", history.channels[i].name, "'"),
                             history.values[i].size(), text(history.time.size(), ", the number of times"));
}

bool has(const History& history, const std::string& channel) {
    return std::ranges::any_of(history.channels,
                               [&](const Channel& one) { return one.name == channel || one.alias == channel; });
}

// What a panel shows, in the order of its channels.
struct Shown {
    const History* history;
    std::size_t channel;
    std::string label;
};

// Of each channel those histories that have it.
std::vector<Shown> shown_in(const HistoryPanel& panel, std::span<const NamedHistory> histories) {
    std::vector<Shown> all;
    for (const std::string& channel : panel.channels) {
        const std::size_t before = all.size();
        for (const auto& [name, history] : histories) {
            if (histories.size() > 1 && !has(*history, channel)) continue;
            const std::size_t index = history->index(channel);  // or the error names those that there are
            const Channel& found = history->channels[index];
            all.push_back({history, index, histories.size() > 1 ? text(name, ": ", found.name) : legend(found)});
        }
        if (all.size() == before)
            throw InputError("picture of several histories", "channel", channel, "one that any of them has");
    }
    return all;
}

// The titles that differ.
std::string joint_title(std::span<const NamedHistory> histories) {
    std::vector<std::string> titles;
    for (const auto& [name, history] : histories)
        if (std::ranges::find(titles, history->title) == titles.end()) titles.push_back(history->title);
    std::string all;
    for (const std::string& title : titles) all += (all.empty() ? "" : " | ") + title;
    return all;
}

void check_some(std::span<const NamedHistory> histories) {
    if (histories.empty()) throw InputError("picture of histories", "number of histories", 0, "at least one");
    for (const auto& [name, history] : histories) check_lengths(*history);
}

std::size_t columns(int width) {
    return static_cast<std::size_t>(std::clamp(width, 1, 20000));
}

}  // namespace

std::vector<HistoryPanel> one_panel_each(const std::vector<std::string>& channels) {
    std::vector<HistoryPanel> panels;
    panels.reserve(channels.size());
    for (const std::string& channel : channels) panels.push_back({{channel}});
    return panels;
}

std::vector<HistoryPanel> panels_by_units(const History& history, const std::vector<std::string>& channels,
                                          AngleUnits angles) {
    std::vector<HistoryPanel> panels;
    std::vector<std::string> units;
    for (const std::string& channel : channels) {
        const std::string own = shown_units(history.channels[history.index(channel)], angles).units;
        std::size_t p = 0;
        while (p < panels.size() && (units[p] != own || panels[p].channels.size() == palette.size())) ++p;
        if (own == "1" || own == "-") p = panels.size();
        if (p == panels.size()) {
            panels.emplace_back();
            units.push_back(own);
        }
        panels[p].channels.push_back(channel);
    }
    return panels;
}

void plot(std::span<const NamedHistory> histories, const std::vector<HistoryPanel>& panels,
          const std::filesystem::path& path, const HistoryPlotOptions& options) {
    check_some(histories);
    PanelStack stack;
    stack.title = options.title.empty() ? joint_title(histories) : options.title;
    stack.x_label = "time, s";
    stack.x_low = std::numeric_limits<double>::infinity();
    stack.x_high = -stack.x_low;
    stack.width = options.width;
    for (const auto& [name, history] : histories) {
        const SampleRange range = samples_between(history->time, options.from, options.to);
        stack.x_low = std::min(stack.x_low, history->time[range.first]);
        stack.x_high = std::max(stack.x_high, history->time[range.first + range.count - 1]);
    }
    for (const HistoryMark& mark : options.marks) stack.marks.push_back({mark.time, mark.label});
    for (const HistoryPanel& panel : panels) {
        PanelCurves curves;
        for (Shown& one : shown_in(panel, histories)) {
            const SampleRange range = samples_between(one.history->time, options.from, options.to);
            const auto part = [&](const std::vector<double>& all) {
                return std::span(all).subspan(range.first, range.count);
            };
            curves.channels.push_back(&one.history->channels[one.channel]);
            curves.labels.push_back(std::move(one.label));
            curves.curves.push_back(min_max_envelope(part(one.history->time), part(one.history->values[one.channel]),
                                                     columns(options.width)));
        }
        stack.panels.push_back(panel.channels.empty() ? StackPanel{} : curves.panel(options.angles, "", false));
    }
    draw(stack, path);
}

void plot(const History& history, const std::vector<HistoryPanel>& panels, const std::filesystem::path& path,
          const HistoryPlotOptions& options) {
    const NamedHistory alone{history.title, &history};
    plot(std::span(&alone, 1), panels, path, options);
}

void plot_energies(const History& history, const std::filesystem::path& path, const HistoryPlotOptions& options) {
    check_lengths(history);
    const std::vector<HistoryPanel> panels{
        {{"kinetic energy", "potential energy", "dissipated energy", "energy from drives", "energy from loads"}},
        {{"energy error"}}};
    History energies{history.title, {}, history.time, {}};
    for (const HistoryPanel& panel : panels)
        for (const std::string& name : panel.channels) {
            const std::size_t i = history.index(name);
            energies.channels.push_back(history.channels[i]);
            energies.values.push_back(history.values[i]);
        }
    // The potential energy of tall machines is measured from the ground: its changes would not be visible.
    std::vector<double>& potential = energies.values[1];
    energies.channels[1].long_name = "change of the potential energy since the start";
    for (double start = potential.empty() ? 0 : potential.front(); double& value : potential) value -= start;
    plot(energies, panels, path, options);
}

void plot_spectra(std::span<const NamedHistory> histories, const std::vector<HistoryPanel>& panels,
                  const std::filesystem::path& path, const SpectrumPlotOptions& options) {
    check_some(histories);
    constexpr const char* place = "picture of spectra";
    require_not_negative(place, "largest frequency [Hz]", options.max_frequency_hz);
    require_not_negative(place, "rotor frequency [Hz]", options.rotor_frequency_hz);
    if (options.blades < 0) throw InputError(place, "number of blades", options.blades, ">= 0");
    PanelStack stack;
    stack.title = options.title.empty() ? joint_title(histories) : options.title;
    stack.x_label = "frequency, Hz";
    stack.x_high = options.max_frequency_hz;
    stack.width = options.width;
    for (const HistoryPanel& panel : panels) {
        PanelCurves curves;
        for (Shown& one : shown_in(panel, histories)) {
            const Channel& channel = one.history->channels[one.channel];
            const Spectrum s = spectrum(*one.history, channel.name, options.spectrum);
            const auto shown = static_cast<std::size_t>(
                options.max_frequency_hz > 0
                    ? std::upper_bound(s.frequency.begin(), s.frequency.end(), options.max_frequency_hz) -
                          s.frequency.begin()
                    : std::ssize(s.frequency));
            const auto y = std::span(options.density ? s.density : s.amplitude).first(shown);
            curves.channels.push_back(&channel);
            curves.labels.push_back(std::move(one.label));
            curves.curves.push_back(min_max_envelope(std::span(s.frequency).first(shown), y, columns(options.width)));
            if (options.max_frequency_hz == 0) stack.x_high = std::max(stack.x_high, s.frequency.back());
        }
        const char* quantity = options.density ? "density, " : "amplitude, ";
        stack.panels.push_back(panel.channels.empty()
                                   ? StackPanel{}
                                   : curves.panel(options.angles, quantity, true, options.density ? 2 : 1));
    }
    const double first_line = options.rotor_frequency_hz / stack.x_high * options.width;
    if (first_line > closest_lines)
        for (int n : rotor_multiples(options.blades))
            stack.marks.push_back({n * options.rotor_frequency_hz, text(n, "P")});
    draw(stack, path);
}

void plot_spectra(const History& history, const std::vector<HistoryPanel>& panels, const std::filesystem::path& path,
                  const SpectrumPlotOptions& options) {
    const NamedHistory alone{history.title, &history};
    plot_spectra(std::span(&alone, 1), panels, path, options);
}

}  // namespace cardan::solvers
