/// @file
/// Channels of a machine beside the usual ones, and those that tables and pictures show without being asked.
#pragma once

#include "programs/shared/command_line.hpp"
#include "programs/shared/machine_file.hpp"
#include "programs/shared/words.hpp"
#include "solvers/pictures/history.hpp"
#include "turbines/model/station_channels.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace cardan::program {

/// Stations along blades and tower.
struct StationOptions {
    std::string blades = {}, tower = {};
};

inline void add_station_options(CommandLine& app, StationOptions& options) {
    app.add_option("--blade-stations", options.blades,
                   "loads, deflections and accelerations also at these places along every blade, from its root, m, "
                   "separated by commas (Spn1MLyb1 ... of OpenFAST)");
    app.add_option("--tower-stations", options.tower,
                   "likewise along the tower, from its foot, m (TwHt1MLyt ... of OpenFAST)");
}

/// "5,10.5"; empty: none.  @throws InputError naming the option
inline std::vector<double> places(const char* option, const std::string& given) {
    return given.empty() ? std::vector<double>() : numbers(option, given, "numbers separated by commas, m");
}

inline turbines::Stations stations_of(const StationOptions& options) {
    return {.blades = places("--blade-stations", options.blades), .tower = places("--tower-stations", options.tower)};
}

/// Checks before the work that all stations are on the machine's blades and tower.  @throws InputError
inline void check_stations(const turbines::Machine& machine, const MachineOptions& machine_options,
                           const StationOptions& options) {
    const turbines::Stations stations = stations_of(options);
    if (stations.blades.empty() && stations.tower.empty()) return;
    MachineOptions coarse = machine_options;
    coarse.blade_elements = coarse.tower_elements = 2;
    const turbines::Turbine turbine = turbines::assemble(machine.description, assembly_options(machine, coarse));
    static_cast<void>(turbines::station_channels(turbine, stations));
}

/// Channels at the stations that were asked for.
inline std::vector<ChannelGroup> station_channels(const turbines::Turbine& turbine, const StationOptions& options) {
    return turbines::station_channels(turbine, stations_of(options));
}

/// All: the usual ones and those at stations.
inline std::vector<ChannelGroup> channels_of(const turbines::Turbine& turbine, const StationOptions& options) {
    std::vector<ChannelGroup> groups = turbines::channels(turbine);
    for (ChannelGroup& group : station_channels(turbine, options)) groups.push_back(std::move(group));
    return groups;
}

inline bool has(const std::vector<Channel>& channels, const std::string& name) {
    return std::ranges::any_of(channels, [&](const Channel& c) { return c.name == name || c.alias == name; });
}

inline std::vector<std::string> all_names(const std::vector<Channel>& channels) {
    std::vector<std::string> names;
    names.reserve(channels.size());
    for (const Channel& channel : channels) names.push_back(channel.name);
    return names;
}

/// Speeds, deflections and loads that are there.
inline std::vector<std::string> main_channels(const turbines::MachineLayout& layout,
                                              const std::vector<Channel>& channels) {
    std::vector<std::string> names{"RotSpeed", "GenTq",    "RotTorq", "TTDspFA",     "TTDspSS",
                                   "TwrBsMyt", "TwrBsMxt", "yaw",     "teeter angle"};
    for (int number : layout.blade_numbers) {
        const std::string blade = text("blade ", number);
        names.insert(names.end(), {blade + " tip out-of-plane deflection", blade + " tip twist",
                                   blade + " root moment y", blade + " root moment x", blade + " root force z"});
    }
    std::erase_if(names, [&](const std::string& name) { return !has(channels, name); });
    return names;
}

/// "TTDspFA+TTDspSS" as one panel.
inline solvers::HistoryPanel panel_of(const std::string& joined) {
    return {split(joined, '+')};
}

/// Panels of the first blade that is there.
inline std::vector<std::string> blade_panels(const turbines::MachineLayout& layout) {
    if (layout.blade_numbers.empty()) return {};
    const std::string blade = text("blade ", layout.blade_numbers.front());
    return {text(blade, " tip out-of-plane deflection+", blade, " tip in-plane deflection"),
            text(blade, " root moment y+", blade, " root moment x")};
}

/// Panels of speeds, deflections and loads, as far as there are any.
inline std::vector<solvers::HistoryPanel> usual_panels(const turbines::MachineLayout& layout,
                                                       const std::vector<Channel>& channels) {
    std::vector<std::string> candidates{"RotSpeed",       "GenTq",           "teeter angle",     "yaw",
                                        "platform pitch", "TTDspFA+TTDspSS", "TwrBsMyt+TwrBsMxt"};
    for (std::string& blade : blade_panels(layout)) candidates.push_back(std::move(blade));
    std::vector<solvers::HistoryPanel> all;
    for (const std::string& joined : candidates)
        if (const solvers::HistoryPanel one = panel_of(joined); has(channels, one.channels.front())) all.push_back(one);
    return all;
}

}  // namespace cardan::program
