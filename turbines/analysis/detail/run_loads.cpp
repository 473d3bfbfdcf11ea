#include "turbines/analysis/detail/run_loads.hpp"

#include "elements/machine_elements/coordinate_force.hpp"
#include "elements/machine_elements/load_over_time.hpp"
#include "turbines/tables/csv.hpp"

#include <numeric>
#include <utility>

namespace cardan::turbines {

namespace {

std::string in_words(const GeneratorLoad& generator) {
    if (const TorqueLaw& law = generator.law; law.acts())
        return text(law.optimal_gain, " N m s^2 speed^2, from ", law.transition_speed(), " rad/s on ", law.slope(),
                    " N m s/rad (speed - ", law.synchronous_speed(), " rad/s), at most ", law.rated_torque, " N m");
    return text(generator.torque, " N m + ", generator.slope, " N m s/rad (speed - ", generator.start, " rad/s)");
}

}  // namespace

Turbine with_generator(const Turbine& turbine, const GeneratorLoad& generator) {
    if (!generator.acts()) return turbine;
    ForceSet forces = turbine.forces();
    const auto law = [generator](double, double, double rate) {
        const TorqueLaw::At at = generator.at(rate);
        return CoordinateLaw{.force = -generator.ratio * at.torque,
                             .by_rate = -generator.ratio * generator.ratio * at.by_speed};
    };
    forces.add_element(coordinate_force("generator", generator.shaft, law, false));
    return turbine.with_forces(forces, text("generator: ", in_words(generator), ", on its own shaft"));
}

ChannelGroup generator_channels(const GeneratorLoad& generator) {
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
    group.sample = [generator](const DynamicView& in, double* values) {
        const double rate = in.qd(in.kinematics.model().index(generator.shaft));
        values[0] = generator.at(rate).torque;
        values[1] = values[0] * generator.ratio * rate;
    };
    return group;
}

FrameLoad load_of(const RotorTorque& torque, FrameId hub) {
    std::vector<Wrench> rows;
    rows.reserve(torque.values.size());
    for (const double value : torque.values) rows.push_back({Vec3::Zero(), Vec3(0, 0, value)});
    return load_over_time("rotor torque", hub, torque.times, std::move(rows), WrenchAxes::frame);
}

namespace {

Turbine with_load(const Turbine& turbine, FrameLoad load, const std::string& remark) {
    ForceSet forces = turbine.forces();
    forces.add_wrench(std::move(load));
    return turbine.with_forces(forces, remark);
}

}  // namespace

Turbine with_rotor_torque(const Turbine& turbine, const RotorTorque& torque) {
    return with_load(turbine, load_of(torque, turbine.layout().hub), in_words(torque));
}

Turbine with_first_rotor_torque(const Turbine& turbine, const RotorTorque& torque) {
    const FrameId hub = turbine.layout().hub;
    const double first = load_of(torque, hub).at(0).moment.z();
    return with_load(
        turbine,
        {.name = "rotor torque", .frame = hub, .wrench = {Vec3::Zero(), Vec3(0, 0, first)}, .axes = WrenchAxes::frame},
        in_words(torque));
}

ChannelGroup rotor_torque_channels(const RotorTorque& torque, FrameId hub) {
    ChannelGroup group;
    group.channels = {{.name = "rotor torque",
                       .units = "N m",
                       .long_name = "prescribed torque on the rotor, positive: drives it",
                       .frame = "rotor axis",
                       .point = "hub"},
                      {.name = "rotor torque power", .units = "W", .long_name = "power of the prescribed torque"}};
    group.sample = [load = load_of(torque, hub), hub](const DynamicView& in, double* values) {
        const auto body = static_cast<std::size_t>(in.kinematics.model().frame(hub).body);
        values[0] = load.at(in.time).moment.z();
        values[1] = values[0] * pose(in.kinematics, hub).R.col(2).dot(in.loads().motion[body].angular_velocity);
    };
    return group;
}

std::string in_words(const RotorTorque& torque) {
    const std::vector<double>&values = torque.values, &times = torque.times;
    if (values.size() == 2 && values[0] == values[1]) return text("rotor torque: ", values[0], " N m");
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    return text("rotor torque: ", values.size(), " rows from ", times.front(), " to ", times.back(),
                " s, first, mean and last ", values.front(), ", ", sum / static_cast<double>(values.size()), ", ",
                values.back(), " N m");
}

RotorTorque read_rotor_torque(const std::filesystem::path& path) {
    const CsvTable table = CsvTable::read(path);
    const auto times = table.column("time", "s"), torques = table.column("torque", "N m");
    RotorTorque torque{{times.begin(), times.end()}, {torques.begin(), torques.end()}};
    static_cast<void>(load_of(torque, FrameId{}));  // checks the rows
    return torque;
}

}  // namespace cardan::turbines
