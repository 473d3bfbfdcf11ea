#include "turbines/reference_turbines/wt600_operation.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/tables/csv.hpp"
#include "turbines/tables/detail/embedded_data.hpp"

#include <cmath>
#include <utility>

namespace cardan::turbines {

namespace {

constexpr double gear_ratio = 50;  // of the data set; the torque table is that of this machine
// The paper's Table 1; at its tip speed ratio the nominal wind gives the speed of rated operation.
constexpr double rated_power = 600e3, rated_wind = 11.86, tip_speed_ratio = 6.25, radius = 21.5;
constexpr double rated_speed = tip_speed_ratio * rated_wind / radius;

KlossCurve induction_machine(const CsvQuantities& q) {
    return {q.number("generator_sync_speed", "rpm") * units::rpm, q.number("generator_breakdown_torque", "N m"),
            q.number("generator_breakdown_slip", "-")};
}

Generator generator_of(const Wt600OperationOptions& options, const MachineLayout& layout,
                       std::shared_ptr<const Switch> grid) {
    Generator generator;
    generator.shaft = *layout.generator;
    generator.gear_ratio = layout.gear_ratio;
    generator.grid = std::move(grid);
    if (options.generator == Wt600Generator::converter)
        generator.law = wt600_torque_table();
    else
        generator.law = options.data.empty() ? wt600_kloss_curve() : wt600_kloss_curve(options.data);
    return generator;
}

Brake brake_of(const MachineLayout& layout, std::shared_ptr<const Switch> valve) {
    Brake brake;
    brake.shaft = *layout.generator;
    brake.gear_ratio = layout.gear_ratio;
    brake.maximum_torque = 6e3;
    brake.ramp = 0.5;
    brake.regularisation = 1;
    brake.applied = std::move(valve);
    return brake;
}

RotorLoad rotor_load_of(const Wt600OperationOptions& options, const MachineLayout& layout) {
    RotorLoad load;
    load.hub = layout.hub;
    load.azimuth = layout.azimuth;
    for (BodyId pitch : layout.pitch) load.pitch.emplace_back(pitch, -1.0 / static_cast<double>(layout.pitch.size()));
    load.pitch_setting = layout.pitch_settings.front();
    load.curve = wt600_rotor_curve();
    load.curve.tower_shadow = options.tower_shadow;
    load.wind = [V = options.wind](double) { return V; };
    return load;
}

}  // namespace

KlossCurve wt600_kloss_curve() {
    constexpr auto file = "wt600_turbine.csv";
    return induction_machine(CsvQuantities::parse(embedded_data(file), file));
}

KlossCurve wt600_kloss_curve(const std::filesystem::path& folder) {
    return induction_machine(CsvQuantities::read(folder / "wt600_turbine.csv"));
}

double wt600_rated_speed() {
    return rated_speed;
}

RotorCurve wt600_rotor_curve() {
    RotorCurve curve;
    curve.radius = radius;
    curve.power = rated_power / (curve.air_density / 2 * pi * radius * radius * std::pow(rated_wind, 3));
    curve.tip_speed_ratio = tip_speed_ratio;
    curve.thrust = 0.8;
    return curve;
}

TorqueTable wt600_torque_table() {
    const RotorCurve curve = wt600_rotor_curve();
    // At the best tip speed ratio the wind speed is w R / l, so the torque goes with the square of the speed.
    const auto best = [&](double speed) {
        return curve.torque(speed * curve.radius / curve.tip_speed_ratio, pi, speed, 0.0);
    };
    std::vector<double> speeds{19 * units::rpm * gear_ratio}, torques{0};
    for (double n : {20.0, 22.0, 24.0, 26.0, 28.0, 30.0, 32.0}) {
        speeds.push_back(n * units::rpm * gear_ratio);
        torques.push_back(best(n * units::rpm) / gear_ratio);
    }
    speeds.push_back(rated_speed * gear_ratio);
    torques.push_back(rated_power / (rated_speed * gear_ratio));
    return {speeds, torques};
}

Wt600Operation wt600_operation(const Wt600OperationOptions& options) {
    if (!(options.wind >= 0) || std::isinf(options.wind))
        throw InputError("600 kW machine", "wind speed [m/s]", options.wind, "finite and >= 0");
    TurbineDescription description = options.data.empty() ? wt600_description() : wt600_description(options.data);
    description.platform = options.platform;
    const JointSupport mechanism = std::exchange(description.blade.pitch, free_joint);
    const Turbine bare = assemble(description, options.assembly);
    const MachineLayout& layout = bare.layout();

    Wt600Operation machine{
        .turbine = bare,
        .grid = std::make_shared<Switch>(options.at_grid),
        .brake_valve = std::make_shared<Switch>(false),
        .pitch = std::make_shared<DriveCommand>(options.pitch, TrajectoryLimits{8 * units::degree, 15 * units::degree}),
        .generator = {},
        .brake = {},
        .rotor = {},
        .channels = {}};
    machine.generator = generator_of(options, layout, machine.grid);
    machine.brake = brake_of(layout, machine.brake_valve);
    machine.rotor = rotor_load_of(options, layout);

    ForceSet forces = bare.forces();
    const bool generator = options.generator != Wt600Generator::none;
    if (generator) forces.add_element(generator_force(machine.generator));
    forces.add_element(brake_force(machine.brake));
    forces.add_element(rotor_load_force(machine.rotor));
    std::vector<ChannelGroup> more{brake_channels(machine.brake), rotor_load_channels(machine.rotor)};
    if (generator) more.insert(more.begin(), generator_channels(machine.generator));
    for (std::size_t k = 0; k < layout.pitch.size(); ++k) {
        ElasticDrive drive{
            text("blade ", k + 1, " pitch drive"), layout.pitch[k], mechanism.stiffness, 0, machine.pitch, -1};
        if (options.assembly.joint_damping) drive.damping = mechanism.damping;
        forces.add_element(drive_force(drive));
        more.push_back(drive_channels(drive));
    }
    machine.turbine = bare.with_forces(forces);
    machine.channels = channels(machine.turbine);
    machine.channels.insert(machine.channels.end(), more.begin(), more.end());
    return machine;
}

}  // namespace cardan::turbines
