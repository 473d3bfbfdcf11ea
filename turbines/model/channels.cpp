#include "turbines/model/channels.hpp"

#include "elements/cardan_beam/section_loads.hpp"
#include "mbs/base/error.hpp"
#include "turbines/model/detail/channel_axes.hpp"
#include "turbines/model/detail/tower_loads.hpp"

#include <utility>

namespace cardan::turbines {

namespace {

// At the root or the tip of a beam, base axes, about the node there.
Wrench beam_load(const DynamicView& in, const CardanBeam& beam, bool tip) {
    const Pose<double> node = pose(in.kinematics, tip ? beam.tip() : beam.nodes.front());
    const Vec6 load = equilibrium_loads(beam, in.kinematics, in.forces, in.loads(), tip ? beam.line.length : 0).values;
    return {node.R * load.head<3>(), node.R * load.tail<3>()};
}

// Forces along and moments about x, y, z of some axes.
void add_loads(ChannelGroup& group, const std::string& where, const std::string& axes, const std::string& point,
               const std::string& force_alias, const std::string& moment_alias, const std::string& suffix,
               const std::array<const char*, 6>& what) {
    for (std::size_t i = 0; i < 6; ++i) {
        const std::string letter(1, "xyz"[i % 3]);
        const bool force = i < 3;
        const std::string& stem = force ? force_alias : moment_alias;
        group.channels.push_back({.name = text(where, force ? " force " : " moment ", letter),
                                  .units = force ? "N" : "N m",
                                  .long_name = text(what[i], " at the ", point),
                                  .frame = axes,
                                  .point = point,
                                  .alias = suffix.empty() ? "" : text(stem, letter, suffix)});
    }
}

ChannelGroup rotor_channels(const Turbine& source) {
    ChannelGroup group;
    group.channels = {{.name = "rotor speed",
                       .units = "rad s-1",
                       .long_name = "angular velocity of the hub about the shaft relative to the nacelle",
                       .frame = "rotor axis",
                       .alias = "RotSpeed"},
                      {.name = "rotor azimuth",
                       .units = "rad",
                       .long_name = "azimuth of blade 1, zero upward, 0 ... 2 pi",
                       .frame = "rotor axis",
                       .alias = "Azimuth"}};
    const bool generator = source.layout().generator.has_value();
    if (generator) {
        group.channels.push_back({.name = "generator speed",
                                  .units = "rad s-1",
                                  .long_name = "speed of the generator behind the gearbox",
                                  .frame = "axis of the generator shaft",
                                  .alias = "GenSpeed"});
        group.channels.push_back({.name = "main shaft torque",
                                  .units = "N m",
                                  .long_name = "torque of the rotor on the main shaft, positive: drives it",
                                  .frame = "hub",
                                  .point = "hub",
                                  .alias = "RotTorq"});
    }
    group.sample = [source, generator](const DynamicView& in, double* values) {
        const MachineLayout& layout = source.layout();
        const Kinematics& kin = in.kinematics;
        const Model& model = kin.model();
        const Pose<double> hub = pose(kin, layout.rotor_centre), shaft = pose(kin, layout.shaft);
        const int hub_body = model.frame(layout.rotor_centre).body, shaft_body = model.frame(layout.shaft).body;
        const auto spin = [&](int body) {
            return body < 0 ? Vec3(Vec3::Zero()) : in.loads().motion[static_cast<std::size_t>(body)].angular_velocity;
        };
        const Vec3 axis = hub.R.col(2), up = shaft.R.transpose() * hub.R.col(0);
        const double azimuth = std::atan2(-up.y(), up.z());
        values[0] = axis.dot(spin(hub_body) - spin(shaft_body));
        values[1] = azimuth < 0 ? azimuth + 2 * pi : azimuth;
        if (!generator) return;
        values[2] = layout.gear_ratio * in.qd(model.index(*layout.generator));
        const auto joint = static_cast<std::size_t>(hub_body);
        Wrench load;
        add_moved(load, in.loads().joint[joint], kin.origin(hub_body), hub.p, -1);
        values[3] = axis.dot(load.moment);
    };
    return group;
}

ChannelGroup teeter_channels(const Turbine& source) {
    ChannelGroup group;
    group.channels = {{.name = "teeter angle",
                       .units = "rad",
                       .long_name = "teeter of the hub, positive moves blade 1 downwind",
                       .frame = "teeter axis",
                       .alias = "RotTeetP"}};
    group.sample = [source](const DynamicView& in, double* values) {
        *values = -in.q(in.kinematics.model().index(*source.layout().teeter));
    };
    return group;
}

// Displacement and angles from the pose, whatever the coordinates are along and about.
ChannelGroup platform_channels(const Turbine& source) {
    ChannelGroup group;
    const auto add = [&](const char* name, const char* units, const char* long_name, const char* alias) {
        group.channels.push_back({.name = name,
                                  .units = units,
                                  .long_name = long_name,
                                  .frame = "ground",
                                  .point = "platform reference point",
                                  .alias = alias});
    };
    add("platform surge displacement", "m", "displacement of the platform downwind", "PtfmSurge");
    add("platform sway displacement", "m", "displacement of the platform to the left", "PtfmSway");
    add("platform heave displacement", "m", "displacement of the platform upward", "PtfmHeave");
    add("platform roll angle", "rad", "roll of the platform, positive lowers its right side", "PtfmRoll");
    add("platform pitch angle", "rad", "pitch of the platform, positive moves the top of the tower downwind",
        "PtfmPitch");
    add("platform yaw angle", "rad", "yaw of the platform, positive seen from above counterclockwise", "PtfmYaw");
    group.sample = [source](const DynamicView& in, double* values) {
        const Pose<double> now = pose(in.kinematics, source.layout().platform->frame);
        write(now.p, values);
        *values++ = std::atan2(now.R(2, 1), now.R(2, 2));
        *values++ = std::atan2(-now.R(2, 0), std::hypot(now.R(2, 1), now.R(2, 2)));
        *values = std::atan2(now.R(1, 0), now.R(0, 0));
    };
    return group;
}

ChannelGroup tower_motion_channels(const Turbine& source) {
    ChannelGroup group;
    const auto add = [&](const char* name, const char* units, const char* long_name, const char* frame,
                         const char* alias) {
        group.channels.push_back({.name = name,
                                  .units = units,
                                  .long_name = long_name,
                                  .frame = frame,
                                  .point = "tower top",
                                  .alias = alias});
    };
    add("tower top fore-aft displacement", "m", "displacement of the tower top downwind", "tower base", "TTDspFA");
    add("tower top side-side displacement", "m", "displacement of the tower top to the left", "tower base", "TTDspSS");
    add("tower top fore-aft deflection", "m", "displacement of the tower top along its own x", "tower top",
        "YawBrTDxp");
    add("tower top side-side deflection", "m", "displacement of the tower top along its own y", "tower top",
        "YawBrTDyp");
    add("tower top fore-aft acceleration", "m s-2", "acceleration of the tower top along its own x", "tower top",
        "YawBrTAxp");
    add("tower top side-side acceleration", "m s-2", "acceleration of the tower top along its own y", "tower top",
        "YawBrTAyp");
    const bool yaw = source.layout().yaw.has_value();
    if (yaw)
        group.channels.push_back({.name = "nacelle yaw",
                                  .units = "rad",
                                  .long_name = "yaw of the nacelle relative to the tower top, positive seen from "
                                               "above counterclockwise",
                                  .frame = "yaw axis",
                                  .alias = "NacYaw"});
    group.sample = [source, yaw](const DynamicView& in, double* values) {
        const MachineLayout& layout = source.layout();
        const Kinematics& kin = in.kinematics;
        const Pose<double> foot = pose(kin, layout.tower_base), top = pose(kin, layout.tower_top);
        const int body = kin.model().frame(layout.tower_top).body;
        Vec3 d = Vec3::Zero(), a = Vec3::Zero();  // a rigid tower on the ground has neither
        if (layout.tower) d = top.p - foot.p - foot.R * layout.tower->line.pose(layout.tower->line.length).p;
        if (body >= 0) a = in.loads().motion[static_cast<std::size_t>(body)].at(top.p);
        const Vec3 in_foot = foot_axes(foot.R).transpose() * d, in_top = top.R.transpose() * d,
                   acceleration = top.R.transpose() * a;
        for (const Vec3* v : {&in_foot, &in_top, &acceleration})
            for (Eigen::Index i : {0, 1}) *values++ = (*v)(i);
        if (yaw) *values = in.q(kin.model().index(*layout.yaw));
    };
    return group;
}

ChannelGroup tower_load_channels(const Turbine& source) {
    ChannelGroup group;
    add_loads(group, "tower base", "tower base", "tower base", "TwrBsF", "TwrBsM", "t",
              {"fore-aft shear force", "side-side shear force", "axial force (tension positive)", "side-side moment",
               "fore-aft moment", "torsional moment"});
    add_loads(group, "tower top", "tower top", "tower top", "YawBrF", "YawBrM", "p",
              {"fore-aft shear force", "side-side shear force", "axial force (tension positive)", "roll moment",
               "pitching moment", "yaw moment"});
    const std::optional<RigidTower> rigid = source.layout().tower ? std::nullopt : std::optional<RigidTower>(source);
    group.sample = [source, rigid](const DynamicView& in, double* values) {
        const std::optional<CardanBeam>& tower = source.layout().tower;
        const Mat3 foot = foot_axes(pose(in.kinematics, source.layout().tower_base).R),
                   top = pose(in.kinematics, source.layout().tower_top).R;
        const Wrench base_load = rigid ? rigid->foot_load(source, in) : beam_load(in, *tower, false),
                     top_load = rigid ? rigid->top_load(source, in) : beam_load(in, *tower, true);
        write(foot.transpose() * base_load.force, values);
        write(foot.transpose() * base_load.moment, values);
        write(top.transpose() * top_load.force, values);
        write(top.transpose() * top_load.moment, values);
    };
    return group;
}

ChannelGroup blade_motion_channels(const Turbine& source, std::size_t k) {
    const int place = source.layout().blade_numbers[k];
    const std::string blade = text("blade ", place), number = place <= 3 ? text(place) : "";
    const auto alias = [&](const char* stem) { return number.empty() ? "" : stem + number; };
    ChannelGroup group;
    const auto add = [&](const char* name, const char* long_name, const char* axes, const char* stem) {
        group.channels.push_back({.name = blade + name,
                                  .units = "m",
                                  .long_name = text(long_name, " of the tip relative to the undeflected blade"),
                                  .frame = blade + axes,
                                  .point = blade + " tip",
                                  .alias = alias(stem)});
    };
    add(" tip out-of-plane deflection", "deflection out of the rotor plane, downwind,", " coned", "OoPDefl");
    add(" tip in-plane deflection", "deflection in the rotor plane, against the rotation,", " coned", "IPDefl");
    add(" tip flap deflection", "flapwise deflection", "", "TipDxb");
    add(" tip edge deflection", "edgewise deflection, toward the trailing edge,", "", "TipDyb");
    add(" tip axial deflection", "deflection along the pitch axis", "", "TipDzb");
    group.channels.push_back({.name = blade + " tip twist",
                              .units = "rad",
                              .long_name = "turn of the tip about its span, after those about the root's other axes",
                              .frame = blade,
                              .point = blade + " tip"});
    const bool pitch = !source.layout().pitch.empty();
    if (pitch)
        group.channels.push_back({.name = blade + " pitch angle",
                                  .units = "rad",
                                  .long_name = "pitch of the blade root, positive toward feather",
                                  .frame = blade + " pitch axis",
                                  .point = blade + " root",
                                  .alias = alias("BldPitch")});
    group.sample = [source, k, pitch](const DynamicView& in, double* values) {
        const MachineLayout& layout = source.layout();
        const CardanBeam& beam = layout.blades[k];
        const Kinematics& kin = in.kinematics;
        const Pose<double> root = pose(kin, layout.blade_roots[k]);
        const Pose<double> tip = pose(kin, beam.tip());
        const Placement at_rest = beam.line.pose(beam.line.length);
        const Vec3 d = tip.p - root.p - root.R * at_rest.p;
        const Mat3 turned = root.R.transpose() * tip.R * at_rest.R.transpose();
        const Vec3 coned = openfast_axes(pose(kin, layout.pitch_axes[k]).R).transpose() * d;
        *values++ = coned.x();
        *values++ = coned.y();
        write(openfast_axes(root.R).transpose() * d, values);
        *values++ = std::atan2(turned(2, 1), turned(2, 2));  // of R_z R_y R_x, x along the span
        if (pitch) *values = layout.pitch_settings[k] - in.q(kin.model().index(layout.pitch[k]));
    };
    return group;
}

ChannelGroup blade_load_channels(const Turbine& source, std::size_t k) {
    const int place = source.layout().blade_numbers[k];
    const std::string blade = text("blade ", place), root = blade + " root";
    const auto suffix = [&](const char* axes) { return place <= 3 ? text(axes, place) : std::string(); };
    ChannelGroup group;
    add_loads(group, root, blade, root, "RootF", "RootM", suffix("b"),
              {"flapwise shear force", "edgewise shear force", "axial force (tension positive)", "edgewise moment",
               "flapwise moment", "pitching moment"});
    ChannelGroup coned;
    add_loads(coned, root + " coned", blade + " coned", root, "RootF", "RootM", suffix("c"),
              {"out-of-plane shear force", "in-plane shear force", "axial force", "in-plane moment",
               "out-of-plane moment", "pitching moment"});
    for (std::size_t i : {0u, 1u, 3u, 4u}) group.channels.push_back(coned.channels[i]);  // z is the same axis
    group.sample = [source, k](const DynamicView& in, double* values) {
        const MachineLayout& layout = source.layout();
        const CardanBeam& beam = layout.blades[k];
        const Wrench load = beam_load(in, beam, false);
        const Mat3 b = openfast_axes(pose(in.kinematics, layout.blade_roots[k]).R),
                   c = openfast_axes(pose(in.kinematics, layout.pitch_axes[k]).R);
        write(b.transpose() * load.force, values);
        write(b.transpose() * load.moment, values);
        for (const Vec3* v : {&load.force, &load.moment})
            for (Eigen::Index i : {0, 1}) *values++ = c.col(i).dot(*v);
    };
    return group;
}

}  // namespace

std::vector<ChannelGroup> channels(const Turbine& turbine) {
    std::vector<ChannelGroup> groups{rotor_channels(turbine)};
    if (turbine.layout().teeter) groups.push_back(teeter_channels(turbine));
    if (turbine.layout().platform) groups.push_back(platform_channels(turbine));
    if (turbine.layout().tower_top != FrameId{}) {  // a blade alone has none
        groups.push_back(tower_motion_channels(turbine));
        groups.push_back(tower_load_channels(turbine));
    }
    for (std::size_t k = 0; k < turbine.layout().blades.size(); ++k) {
        groups.push_back(blade_motion_channels(turbine, k));
        groups.push_back(blade_load_channels(turbine, k));
    }
    return groups;
}

ChannelGroup drive_channels(const Turbine& turbine) {
    const CoordinateTable& table = turbine.system().model.coordinates();
    ChannelGroup group;
    std::vector<int> driven;
    for (int a = 0; a < table.size(); ++a) {
        if (table[a].role != CoordinateRole::prescribed) continue;
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
    group.sample = [driven](const DynamicView& at, double* values) {
        for (int a : driven) {
            *values++ = at.q(a);
            *values++ = at.actuator(a);
        }
    };
    return group;
}

}  // namespace cardan::turbines
