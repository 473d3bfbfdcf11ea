#include "turbines/reference_turbines/nrel5mw_platform.hpp"

#include "elements/sections/beam_line.hpp"
#include "mbs/base/error.hpp"
#include "turbines/reference_turbines/nrel5mw_geometry.hpp"

#include <limits>

namespace cardan::turbines {

namespace {

constexpr auto machine_name = "NREL 5 MW machine on a platform";

PlatformDescription driven_platform() {
    PlatformDescription platform;
    platform.coordinates.directions = {Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ(),
                                       Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ()};
    platform.coordinates.rotations = {BaseCoordinate::roll, BaseCoordinate::pitch, BaseCoordinate::yaw};
    return platform;
}

// A table, so that the description can be written to a file.
BeamLine rigid_massless_line(double length) {
    EngineeringSection section;
    section.GJ = section.EI_flap = section.EI_edge = std::numeric_limits<double>::infinity();
    BeamTable table;
    table.name = "tower";
    table.stations = {0, length};
    table.sections = {section, section};
    return beam_line(table);
}

}  // namespace

TurbineDescription nrel5mw_platform_description(const Nrel5mwBlade& blade, const Nrel5mwPlatformOptions& options) {
    if (options.blades < 1 || options.blades > 3)
        throw InputError(machine_name, "number of blades", options.blades, "1 ... 3");
    const Nrel5mwGeometry& geometry = nrel5mw_geometry();
    TurbineDescription d;
    d.name = machine_name;
    d.source = blade.source;
    d.rotor_speed = geometry.rated_speed;
    for (int missing = options.blades + 1; missing <= d.blades; ++missing) d.individual_blades[missing] = std::nullopt;
    d.tower.line = rigid_massless_line(geometry.tower_height);
    d.tower.rigid = true;
    d.platform = driven_platform();
    d.yaw.rotation = prescribed_joint;
    d.nacelle.shaft_height = geometry.shaft_above_tower;
    d.nacelle.tilt = geometry.tilt;
    d.nacelle.overhang = geometry.overhang;
    d.drive_train.main_shaft = rigid_joint;
    d.drive_train.spin = CoordinateRole::prescribed;
    d.hub.radius = blade.root_radius;
    d.blade.line = blade.line;
    d.blade.pitch = prescribed_joint;
    d.blade.cone = geometry.cone;
    d.blade.damping = options.elements.damping;
    return d;
}

CardanBeamOptions nrel5mw_platform_elements(int elements, double beta) {
    CardanBeamOptions options = nrel5mw_blade_elements(elements);
    options.damping = BeamDamping::rayleigh(0, beta);
    return options;
}

Nrel5mwBlade nrel5mw_platform_blade() {
    Nrel5mwBladeOptions options;
    options.shear_ratio = 20;
    return nrel5mw_blade(options);
}

Turbine nrel5mw_on_platform(const Nrel5mwBlade& blade, const Nrel5mwPlatformOptions& options) {
    const TurbineDescription description = nrel5mw_platform_description(blade, options);
    AssemblyOptions assembly;
    assembly.pitch = options.pitch;
    assembly.gravity = options.gravity;
    assembly.blade_beam = options.elements;
    assembly.blade_beam->damping = {};
    return assemble(description, assembly);
}

namespace {

// What the channels of one blade are computed from.
struct BladeFrames {
    FrameId axes, tip;
    int pitch;            // body whose joint carries the blade
    Vec3 undeformed_tip;  // in `axes`
};

std::vector<Channel> channels_of(int number) {
    const std::string blade = text("blade ", number), axes = blade + " pitch axis";
    const auto alias = [number](const char* channel) { return text(channel, number); };
    const auto tip = [&](const char* direction, const char* long_name, const std::string& openfast) {
        return Channel{blade + " tip " + direction + " deflection", "m", long_name, axes, blade + " tip", openfast};
    };
    const auto root = [&](const char* component, const char* units, const char* what, const std::string& openfast) {
        return Channel{blade + " root " + component,
                       units,
                       text(what, " of the hub on the blade"),
                       axes,
                       blade + " root",
                       openfast};
    };
    return {tip("axial", "deflection of the tip along the pitch axis", ""),
            tip("edge", "deflection of the tip toward the leading edge", ""),
            tip("flap", "deflection of the tip downwind", alias("TipDxc")),
            root("Fx", "N", "force along the pitch axis", ""),
            root("Fy", "N", "force toward the leading edge", ""),
            root("Fz", "N", "force downwind", ""),
            root("Mx", "N m", "moment about the pitch axis", ""),
            root("My", "N m", "flapwise moment, about the axis to the leading edge,", alias("RootMyc")),
            root("Mz", "N m", "edgewise moment, about the downwind axis,", "")};
}

void sample_blade(const DynamicView& at, const BladeFrames& blade, double* values) {
    const Pose<double> axes = pose(at.kinematics, blade.axes), tip = pose(at.kinematics, blade.tip);
    const Wrench& root = at.loads().joint[static_cast<std::size_t>(blade.pitch)];
    Eigen::Map<Vec3>(values, 3) = axes.R.transpose() * (tip.p - axes.p) - blade.undeformed_tip;
    Eigen::Map<Vec3>(values + 3, 3) = axes.R.transpose() * root.force;
    Eigen::Map<Vec3>(values + 6, 3) = axes.R.transpose() * root.moment;
}

}  // namespace

ChannelGroup blade_channels(const Turbine& machine) {
    ChannelGroup group;
    std::vector<BladeFrames> blades;
    const MachineLayout& layout = machine.layout();
    const Model& model = machine.system().model;
    Workspace workspace(model);
    const Kinematics at_rest = kinematics(model, Vector::Zero(model.size()), workspace);
    for (std::size_t k = 0; k < layout.pitch.size(); ++k) {
        const std::vector<Channel> channels = channels_of(layout.blade_numbers[k]);
        group.channels.insert(group.channels.end(), channels.begin(), channels.end());
        const FrameId axes = layout.pitch_axes[k], tip = layout.blades[k].tip();
        const Pose<double> axes_at = pose(at_rest, axes), tip_at = pose(at_rest, tip);
        blades.push_back({axes, tip, model.index(layout.pitch[k]), axes_at.R.transpose() * (tip_at.p - axes_at.p)});
    }
    group.sample = [blades](const DynamicView& at, double* values) {
        for (const BladeFrames& blade : blades) {
            sample_blade(at, blade, values);
            values += 9;
        }
    };
    return group;
}

}  // namespace cardan::turbines
