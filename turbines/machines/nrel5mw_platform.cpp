#include "turbines/machines/nrel5mw_platform.hpp"

#include "mbs/base/error.hpp"
#include "turbines/machines/nrel5mw_geometry.hpp"
#include "turbines/model/description.hpp"

namespace cardan::turbines {

namespace {

constexpr auto machine_name = "NREL 5 MW machine on a platform";

void check(const Nrel5mwBlade& blade, const Nrel5mwPlatformOptions& options) {
    if (options.blades < 1 || options.blades > 3)
        throw InputError(machine_name, "number of blades", options.blades, "1 ... 3");
    if (!std::isfinite(options.pitch)) throw InputError(machine_name, "pitch [rad]", options.pitch, "finite");
    if (!options.gravity.allFinite())
        throw InputError(machine_name, "gravity [m/s^2]", text(options.gravity.transpose()), "finite");
    if (options.elements.elements > 1000)
        throw InputError(blade.line.name, "number of elements", options.elements.elements, "1 ... 1000");
    if (options.elements.extension && !(blade.line.section(0).compliance(0, 0) > 0))
        throw InputError(blade.line.name, "free extension with EA [N]", std::numeric_limits<double>::infinity(),
                         "finite EA, or extension condensed");
}

class Builder {
public:
    Builder(const Nrel5mwBlade& blade, const Nrel5mwPlatformOptions& options, Nrel5mwPlatform& machine)
        : blade_(blade), options_(options), machine_(machine) {
        forces_.set_gravity(options.gravity);
    }

    void build() {
        add_platform();
        const FrameId shaft = add_nacelle();
        add_hub(shaft);
        for (int k = 1; k <= options_.blades; ++k) add_blade(k);
        machine_.system = std::make_shared<const System>(tree_, forces_);
        fill_rotor_map(shaft);
    }

private:
    JointedFrame driven(FrameId carrier, Axis axis, const std::string& joint, const PartLabel& label,
                        const Vec3& offset = Vec3::Zero()) {
        return add_joint(tree_, carrier, JointKind::revolute, axis, joint, label, offset, CoordinateRole::driven);
    }

    void add_platform() {
        MovingBaseOptions base;
        base.directions = {Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ()};
        base.rotations = {BaseCoordinate::roll, BaseCoordinate::pitch, BaseCoordinate::yaw};
        machine_.platform = add_moving_base(tree_, Tree::base(), "platform", base);
    }

    FrameId add_nacelle() {
        const Vec3 top(0, 0, geometry_.tower_height), centre(0, 0, geometry_.shaft_above_tower);
        const JointedFrame yaw = driven(machine_.platform.frame, Axis::z, "nacelle yaw", {"yaw"}, top);
        machine_.yaw = yaw.body;
        return tree_.add_frame(yaw.frame, Placement{rot_y(geometry_.tilt), centre}, "shaft");
    }

    void add_hub(FrameId shaft) {
        const Vec3 upwind(-geometry_.overhang, 0, 0);
        const JointedFrame spin = driven(shaft, Axis::x, "spin", {"rotor"}, upwind);
        machine_.spin = spin.body;
        machine_.apex = tree_.add_frame(spin.frame, Placement::rotation(hub_axes()), "hub");
    }

    void add_blade(int number) {
        const std::string blade = text("blade ", number);
        const Placement root = Placement::rotation(rot_z(2 * pi * (number - 1) / 3) * rot_y(-geometry_.cone)) *
                               Placement::translation({blade_.root_radius, 0, 0});
        Nrel5mwPlatform::Blade added;
        added.axes = tree_.add_frame(machine_.apex, root, blade + " coned axes");
        const JointedFrame pitch = driven(added.axes, Axis::x, blade + " pitch", {"pitch", number});
        added.pitch = pitch.body;
        const FrameId turned =
            tree_.add_frame(pitch.frame, Placement::rotation(rot_x(-options_.pitch)), blade + " root");
        added.beam = add_cardan_beam(tree_, forces_, turned, blade_.line, blade, {"blade", number}, options_.elements);
        machine_.blades.push_back(std::move(added));
    }

    void fill_rotor_map(FrameId shaft) {
        const Model& model = machine_.system->model;
        RotorMap& rotor = machine_.rotor;
        rotor.machine = machine_name;
        rotor.description = text(options_.blades, " blade(s) of ", machine_.blades[0].beam.elements.size(),
                                 " elements, everything else rigid and driven\n\nread from (before changes made in a "
                                 "program)\n",
                                 blade_.source);
        rotor.spin = model.index(machine_.spin);
        rotor.hub = machine_.apex;
        rotor.parts = {{"blade",
                        machine_.blades[0].axes,
                        {"blade extension", "", ""},
                        {"blade torsion", "blade flap", "blade edge"}}};
        rotor.lines = {{"shaft", 0, {machine_.platform.frame, shaft, machine_.apex}}};
        for (std::size_t k = 0; k < machine_.blades.size(); ++k) {
            const CardanBeam& beam = machine_.blades[k].beam;
            rotor.blades.emplace_back();
            for (const CardanBeam::Element& element : beam.elements)
                for (const BodyId body : element.bodies) rotor.blades.back().push_back(model.index(body));
            std::vector<FrameId> points{machine_.apex};
            points.insert(points.end(), beam.nodes.begin(), beam.nodes.end());
            rotor.lines.push_back({"blade", static_cast<int>(k) + 1, points});
        }
    }

    const Nrel5mwBlade& blade_;
    const Nrel5mwPlatformOptions& options_;
    Nrel5mwPlatform& machine_;
    const Nrel5mwGeometry& geometry_ = nrel5mw_geometry();
    Tree tree_;
    ForceSet forces_;
};

}  // namespace

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

Nrel5mwPlatform nrel5mw_on_platform(const Nrel5mwBlade& blade, const Nrel5mwPlatformOptions& options) {
    check(blade, options);
    Nrel5mwPlatform machine;
    Builder(blade, options, machine).build();
    return machine;
}

namespace {

// What the channels of one blade are computed from.
struct BladeFrames {
    FrameId axes, tip;
    int pitch;            // body whose joint carries the blade
    Vec3 undeformed_tip;  // in `axes`
};

std::vector<Channel> channels_of(int number) {
    const std::string blade = text("blade ", number), axes = blade + " coned axes";
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

void sample_blade(const ChannelInput& at, const BladeFrames& blade, double* values) {
    const Pose<double> axes = pose(at.kinematics, blade.axes), tip = pose(at.kinematics, blade.tip);
    const Wrench& root = at.loads.joint[static_cast<std::size_t>(blade.pitch)];
    Eigen::Map<Vec3>(values, 3) = axes.R.transpose() * (tip.p - axes.p) - blade.undeformed_tip;
    Eigen::Map<Vec3>(values + 3, 3) = axes.R.transpose() * root.force;
    Eigen::Map<Vec3>(values + 6, 3) = axes.R.transpose() * root.moment;
}

}  // namespace

ChannelGroup blade_channels(const Nrel5mwPlatform& machine) {
    ChannelGroup group;
    std::vector<BladeFrames> blades;
    const Model& model = machine.system->model;
    Workspace workspace(model);
    const Kinematics at_rest = kinematics(model, Vector::Zero(model.size()), workspace);
    for (const Nrel5mwPlatform::Blade& blade : machine.blades) {
        const std::vector<Channel> channels = channels_of(static_cast<int>(blades.size()) + 1);
        group.channels.insert(group.channels.end(), channels.begin(), channels.end());
        const Pose<double> axes = pose(at_rest, blade.axes), tip = pose(at_rest, blade.beam.tip());
        blades.push_back(
            {blade.axes, blade.beam.tip(), model.index(blade.pitch), axes.R.transpose() * (tip.p - axes.p)});
    }
    group.sample = [blades](const ChannelInput& at, double* values) {
        for (const BladeFrames& blade : blades) {
            sample_blade(at, blade, values);
            values += 9;
        }
    };
    return group;
}

ChannelGroup drive_channels(const Nrel5mwPlatform& machine) {
    const CoordinateTable& table = machine.system->model.coordinates();
    ChannelGroup group;
    std::vector<int> driven;
    for (int a = 0; a < table.size(); ++a) {
        if (table[a].role != CoordinateRole::driven) continue;
        driven.push_back(a);
        group.channels.push_back({.name = table[a].name,
                                  .units = table[a].unit,
                                  .long_name = text("position of the coordinate '", table[a].name, "'"),
                                  .frame = "axis of " + table[a].name});
        group.channels.push_back({.name = table[a].name + " drive",
                                  .units = table[a].unit == "rad" ? "N m" : "N",
                                  .long_name = text("force of the drive on the coordinate '", table[a].name, "'"),
                                  .frame = "axis of " + table[a].name});
    }
    group.sample = [driven](const ChannelInput& at, double* values) {
        for (int a : driven) {
            *values++ = at.q(a);
            *values++ = at.actuator(a);
        }
    };
    return group;
}

}  // namespace cardan::turbines
