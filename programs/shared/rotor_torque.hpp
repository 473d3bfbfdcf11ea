/// @file
/// The option --rotor-torque: a torque that drives the rotor, constant or as a table over time.
#pragma once

#include "elements/machine/load_over_time.hpp"
#include "mbs/system/channel.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/tables/csv.hpp"

#include "programs/shared/command_line.hpp"
#include "programs/shared/words.hpp"
#include <numeric>
#include <string>
#include <vector>

namespace cardan::program {

/// About the axis of the hub, which it turns with; positive drives positive rotation.
struct RotorTorque {
    std::vector<double> times, values;  ///< s, N m; linear in between, constant before and after; empty: none

    bool acts() const { return !times.empty(); }
    double first() const { return values.front(); }
    /// A follower load at the hub, about its z axis.
    FrameLoad load(FrameId hub) const {
        std::vector<Wrench> rows;
        for (const double torque : values) rows.push_back({Vec3::Zero(), Vec3(0, 0, torque)});
        return load_over_time("rotor torque", hub, times, std::move(rows), WrenchAxes::frame);
    }
    /// That at time zero, for ever: for a start in the steady state.
    FrameLoad first_load(FrameId hub) const {
        return {.name = "rotor torque",
                .frame = hub,
                .wrench = {Vec3::Zero(), Vec3(0, 0, load(hub).at(0).moment.z())},
                .axes = WrenchAxes::frame};
    }
    /// For the file of a run: enough to tell another table.
    std::string in_words() const {
        if (values.size() == 2 && values[0] == values[1]) return text("rotor torque: ", values[0], " N m");
        const double sum = std::accumulate(values.begin(), values.end(), 0.0);
        return text("rotor torque: ", values.size(), " rows from ", times.front(), " to ", times.back(),
                    " s, first, mean and last ", values.front(), ", ", sum / static_cast<double>(values.size()), ", ",
                    values.back(), " N m");
    }
};

inline void add_rotor_torque(CommandLine& app, std::string& given) {
    app.add_option(
           "--rotor-torque", given,
           "torque on the rotor, N m, positive drives positive rotation: a number, or a file (.csv) with columns "
           "time[s],torque[N m]")
        .type_name("NUMBER|FILE");
}

/// @param given  as the option; empty: none
/// @throws FileError, ParseError, InputError
inline RotorTorque rotor_torque(const std::string& given) {
    if (given.empty()) return {};
    const ReadNumber read = read_number(given);
    if (read.good()) return {{0, 1}, {read.value, read.value}};
    if (read.fault != ReadNumber::no_number) throw InputError("--rotor-torque", "value [N m]", given, "finite");
    const turbines::CsvTable table = turbines::CsvTable::read(given);
    const auto times = table.column("time", "s"), torques = table.column("torque", "N m");
    RotorTorque torque{{times.begin(), times.end()}, {torques.begin(), torques.end()}};
    static_cast<void>(torque.load(FrameId{}));  // checks the rows
    return torque;
}

/// "rotor torque" and "rotor torque power".
inline ChannelGroup rotor_torque_channels(const RotorTorque& torque, FrameId hub) {
    ChannelGroup group;
    group.channels = {{.name = "rotor torque",
                       .units = "N m",
                       .long_name = "prescribed torque on the rotor, positive: drives it",
                       .frame = "rotor axis",
                       .point = "hub"},
                      {.name = "rotor torque power", .units = "W", .long_name = "power of the prescribed torque"}};
    group.sample = [load = torque.load(hub), hub](const ChannelInput& in, double* values) {
        const auto body = static_cast<std::size_t>(in.kinematics.model().frame(hub).body);
        values[0] = load.at(in.time).moment.z();
        values[1] = values[0] * pose(in.kinematics, hub).R.col(2).dot(in.loads.motion[body].angular_velocity);
    };
    return group;
}

}  // namespace cardan::program
