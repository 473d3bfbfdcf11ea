#include "turbines/model/detail/assembler.hpp"

#include "elements/sections/quadrature.hpp"
#include "mbs/base/error.hpp"
#include "turbines/model/detail/beam_options.hpp"

#include <Eigen/Geometry>

namespace cardan::turbines {

namespace {

CardanBeamOptions damped(CardanBeamOptions beam, const BeamDamping& damping) {
    beam.damping = damping;
    return beam;
}

// Of an undeformed beam, about its root: int [x; 1] [x; 1]^T dm and the sections' own tensors.
RigidInertia rigid_inertia(const BeamLine& line) {
    const Eigen::Matrix4d moments =
        integrate(0, line.length, line.breaks, Eigen::Matrix4d(Eigen::Matrix4d::Zero()), [&](double x) {
            const BeamSection section = line.section(x);
            const Placement at = line.pose(x);
            Eigen::Vector4d centre;
            centre << at.p + at.R * section.centre, 1;
            Eigen::Matrix4d per_length = section.mass * centre * centre.transpose();
            per_length.topLeftCorner<3, 3>() += at.R * binet_tensor<double>(section.J) * at.R.transpose();
            return per_length;
        });
    RigidInertia beam;
    beam.mass = moments(3, 3);
    if (beam.mass == 0) return beam;
    beam.com = moments.topRightCorner<3, 1>() / beam.mass;
    beam.J = ordinary_tensor<double>(moments.topLeftCorner<3, 3>() - beam.mass * beam.com * beam.com.transpose());
    return beam;
}

bool is_empty(const BeamDamping& damping) {
    return !damping.needs_modes() && damping.time_constants == BeamDamping().time_constants;
}

}  // namespace

Assembler::Assembler(const TurbineDescription& description, const AssemblyOptions& options, const PartDamping& damping)
    : d_(description), options_(options), damping_(damping) {
    if (!(std::isfinite(options.pitch))) throw InputError(d_.name, "pitch [rad]", options.pitch, "finite");
    check_elements(options);
    check("tower", options.tower_beam);
    check("blade", options.blade_beam);
    forces.set_gravity(options.gravity);
}

void Assembler::tower_alone(const RigidInertia& head) {
    const FrameId top = add_tower();
    if (!head.is_massless()) tree.weld(top, head, "tower top");
    add_tower_axes();
}

void Assembler::whole_machine() {
    add_platform();
    const FrameId top = add_tower();
    const FrameId nacelle = add_yaw_and_nacelle(top);
    const FrameId shaft = add_tilt(nacelle);
    const FrameId hub = add_hub(options_.shaft_beam ? add_drive_train_with_beam(shaft) : add_drive_train(shaft));
    lines.push_back({"shaft", 0, {top, shaft, hub}});
    tree.weld(hub, d_.hub.inertia, "hub");
    add_blades(hub);
    if (layout.platform) add_water_forces(forces, tree, *layout.platform, *d_.platform, warnings);
    if (!d_.tower.rigid) add_tower_axes();
}

void Assembler::one_blade(int number) {
    const BladeDescription* blade = number < 1 || number > d_.blades ? nullptr : d_.blade_at(number);
    if (blade == nullptr) throw InputError(d_.name, "number of the blade", number, "that of a blade of the machine");
    layout.shaft = Tree::base();
    const JointedFrame spinner = add_joint(tree, layout.shaft, JointKind::revolute, Axis::x, "spin", {"rotor"},
                                           Vec3::Zero(), options_.spin.value_or(d_.drive_train.spin));
    spin = spinner.body;
    hub_is_driven = true;
    layout.azimuth = {{spinner.body, 1.0}};
    add_blade(add_hub(add_rotor_centre(spinner.frame, {})), number, *blade, false);
}

void Assembler::check(const char* part, const std::optional<CardanBeamOptions>& beam) const {
    if (!beam) return;
    if (beam->elements > 1000) throw InputError(d_.name, "number of elements", beam->elements, "1 ... 1000");
    if (!is_empty(beam->damping))
        throw InputError(d_.name, text("damping among the options of the elements of the ", part), "given",
                         "none: it belongs into the description");
}

FrameId Assembler::past_joint(FrameId carrier, JointKind kind, Axis axis, const std::string& name,
                              const PartLabel& label, const JointSupport& bearing) {
    return bearing.is_rigid() ? carrier : jointed(carrier, kind, axis, name, label, bearing).frame;
}

JointedFrame Assembler::jointed(FrameId carrier, JointKind kind, Axis axis, const std::string& name,
                                const PartLabel& label, const JointSupport& bearing, const Vec3& offset) {
    const bool driven = bearing.kind == JointSupport::Kind::prescribed;
    const JointedFrame joint = add_joint(tree, carrier, kind, axis, name, label, offset,
                                         driven ? CoordinateRole::prescribed : CoordinateRole::free);
    if (!driven) forces.add_spring(name, joint.body, bearing.stiffness, options_.joint_damping ? bearing.damping : 0.0);
    return joint;
}

void Assembler::add_platform() {
    if (!d_.platform) return;
    const PlatformFrames platform = turbines::add_platform(tree, *d_.platform);
    layout.platform = platform.base;
    foundation_ = platform.tower_base;
    if (platform.line.size() > 1) lines.push_back({"platform", 0, platform.line});
    parts.push_back({"platform",
                     Tree::base(),
                     {"platform surge", "platform sway", "platform heave"},
                     {"platform roll", "platform pitch", "platform yaw"}});
}

FrameId Assembler::add_tower() {
    const Mat3 upward = axis_rotation(Axis::y);  // x -> z, y -> x, z -> y
    layout.tower_base = tree.add_frame(foundation_, Placement::rotation(upward), "tower foot");
    const FrameId tip = d_.tower.rigid ? add_rigid_tower(layout.tower_base) : add_flexible_tower(layout.tower_base);
    return layout.tower_top = tree.add_frame(tip, Placement::rotation(upward.transpose()), "tower top");
}

FrameId Assembler::add_flexible_tower(FrameId foot) {
    layout.tower = add_cardan_beam(tree, forces, foot, d_.tower.line, "tower", {"tower"},
                                   damped(tower_beam_options(d_.tower, options_), damping_.tower));
    keep(*layout.tower);
    lines.push_back({"tower", 0, layout.tower->nodes});
    return layout.tower->tip();
}

FrameId Assembler::add_rigid_tower(FrameId foot) {
    const BeamLine& line = d_.tower.line;
    require_positive("tower", "length [m]", line.length);
    const RigidInertia whole = line.section ? rigid_inertia(line) : RigidInertia{};
    if (!whole.is_massless()) tree.weld(foot, whole, "tower");
    const FrameId tip = tree.add_frame(foot, line.pose(line.length), "tower tip");
    lines.push_back({"tower", 0, {foot, tip}});
    return tip;
}

void Assembler::add_tower_axes() {
    parts.insert(
        parts.begin(),
        {"tower", foundation_, {"", "", "tower extension"}, {"tower side-side", "tower fore-aft", "tower torsion"}});
}

FrameId Assembler::add_yaw_and_nacelle(FrameId top) {
    const PartLabel label{"yaw"};
    FrameId at = top;
    at = past_joint(at, JointKind::prismatic, Axis::x, "yaw bearing x", label, d_.yaw.translation);
    at = past_joint(at, JointKind::prismatic, Axis::y, "yaw bearing y", label, d_.yaw.translation);
    if (!d_.yaw.rotation.is_rigid()) {
        const JointedFrame yaw = jointed(at, JointKind::revolute, Axis::z, "yaw", label, d_.yaw.rotation);
        at = yaw.frame;
        layout.yaw = yaw.body;
    }
    tree.weld(at, d_.nacelle.inertia, "nacelle");
    parts.push_back({"yaw", foundation_, {"yaw bearing fore-aft", "yaw bearing side-side", ""}, {"", "", "rotor yaw"}});
    return tree.add_frame(at, {}, "nacelle");
}

FrameId Assembler::add_tilt(FrameId nacelle) {
    const Vec3 centre(0, 0, d_.nacelle.shaft_height);
    if (d_.nacelle.tilt_bearing.is_rigid())
        return tree.add_frame(nacelle, Placement::translation(centre) * Placement::rotation(rot_y(d_.nacelle.tilt)),
                              "shaft");
    const JointedFrame tilt =
        jointed(nacelle, JointKind::revolute, Axis::y, "tilt", {"tilt"}, d_.nacelle.tilt_bearing, centre);
    parts.push_back({"tilt", foundation_, {}, {"", "rotor tilt", ""}});
    return tree.add_frame(tilt.frame, Placement::rotation(rot_y(d_.nacelle.tilt)), "shaft");
}

// Generator and gearbox are armatures about the shaft; the coordinates are relative to each other.
FrameId Assembler::add_generator_and_gearbox(FrameId shaft) {
    const DriveTrainDescription& t = d_.drive_train;
    const double squared = t.gear_ratio * t.gear_ratio;
    const PartLabel label{"drive train"};
    const JointedFrame generator = add_joint(tree, shaft, JointKind::revolute, Axis::x, "generator azimuth", label,
                                             Vec3::Zero(), options_.spin.value_or(d_.drive_train.spin));
    spin = generator.body;
    layout.generator = generator.body;
    layout.gear_ratio = t.gear_ratio;
    layout.shaft = shaft;
    layout.azimuth = {{generator.body, 1.0}};
    if (!t.shaft.is_massless()) tree.weld(generator.frame, t.shaft, "shaft");
    FrameId at = generator.frame;
    if (!t.high_speed_shaft.is_rigid()) {
        const JointedFrame gearbox =
            jointed(at, JointKind::revolute, Axis::x, "high-speed shaft twist", label,
                    {t.high_speed_shaft.stiffness * squared, t.high_speed_shaft.damping * squared});
        layout.azimuth.emplace_back(gearbox.body, 1.0);
        at = gearbox.frame;
    }
    if (t.generator_inertia > 0)
        tree.add_armature({"generator", t.generator_inertia * squared, {{generator.body, 1.0}}});
    if (t.gearbox_inertia > 0) tree.add_armature({"gearbox", t.gearbox_inertia, layout.azimuth});
    parts.push_back({"drive train", shaft, {}, {"drive-train torsion", "", ""}});
    return at;
}

FrameId Assembler::add_drive_train(FrameId shaft) {
    FrameId at = add_generator_and_gearbox(shaft);
    if (!d_.drive_train.main_shaft.is_rigid()) {
        const JointedFrame hub =
            jointed(at, JointKind::revolute, Axis::x, "main shaft twist", {"drive train"}, d_.drive_train.main_shaft);
        layout.azimuth.emplace_back(hub.body, 1.0);
        at = hub.frame;
    }
    return add_rotor_centre(at, Placement::translation({-d_.nacelle.overhang, 0, 0}));
}

FrameId Assembler::add_drive_train_with_beam(FrameId shaft) {
    if (d_.drive_train.main_shaft.is_rigid())
        throw InputError(d_.name, "torsional stiffness of the main shaft as a beam [N m/rad]", "rigid", "a spring");
    require_positive(d_.name, "overhang of a main shaft as a beam [m]", d_.nacelle.overhang);
    const FrameId gearbox = add_generator_and_gearbox(shaft);
    EngineeringSection section;
    section.mass = options_.shaft_beam->mass;
    section.EI_flap = section.EI_edge = options_.shaft_beam->EI;
    section.GJ = d_.drive_train.main_shaft.stiffness * d_.nacelle.overhang;
    // The beam runs upwind: x reversed.
    const FrameId start = tree.add_frame(gearbox, Placement::rotation(rot_z(pi)), "shaft start");
    const BeamLine line = uniform_beam(d_.nacelle.overhang, section, "main shaft");
    const CardanBeam beam =
        add_cardan_beam(tree, forces, start, line, "main shaft", {"drive train"}, shaft_beam_options(options_));
    const auto& e = beam.elements.front();
    if (options_.joint_damping)
        forces.add_spring("main shaft damper", e.bodies[2], 0, d_.drive_train.main_shaft.damping);
    layout.azimuth.emplace_back(e.bodies[2], -1.0);        // torsion, about the axis of the beam
    rotating_pairs.push_back({e.bodies[0], e.bodies[1]});  // (ay1, az1)
    rotating_pairs.push_back({e.bodies[4], e.bodies[3]});  // (ay2, az2)
    parts.back().rotation = {"drive-train torsion", "shaft bending", "shaft bending"};
    return add_rotor_centre(beam.tip(), Placement::rotation(rot_z(pi)));
}

// Hub axes on what spins; `place` has shaft axes.
FrameId Assembler::add_rotor_centre(FrameId carrier, const Placement& place) {
    layout.rotor_centre = tree.add_frame(carrier, place * Placement::rotation(hub_axes()), "rotor centre");
    return layout.rotor_centre;
}

FrameId Assembler::add_hub(FrameId rotor_centre) {
    const bool teeters = d_.hub.teeter && !d_.hub.teeter->bearing.is_rigid();
    layout.hub = teeters ? add_teeter(rotor_centre, *d_.hub.teeter) : tree.add_frame(rotor_centre, {}, "hub");
    return layout.hub;
}

FrameId Assembler::add_teeter(FrameId rotor_centre, const TeeterDescription& teeter) {
    const FrameId axis = tree.add_frame(rotor_centre, Placement::rotation(rot_z(-teeter.delta3)), "teeter axis");
    const JointedFrame turned = jointed(axis, JointKind::revolute, Axis::y, "teeter", {"teeter"}, teeter.bearing);
    layout.teeter = turned.body;
    if (teeter.bearing.kind != JointSupport::Kind::prescribed) odd.push_back(turned.body);
    parts.push_back({"teeter", rotor_centre, {}, {"", "teeter", ""}});
    return tree.add_frame(turned.frame, Placement::rotation(rot_z(teeter.delta3)), "hub");
}

void Assembler::add_blades(FrameId hub) {
    places = d_.blades;
    for (int k = 1; k <= d_.blades; ++k)
        if (const BladeDescription* blade = d_.blade_at(k)) add_blade(hub, k, *blade, !blade->pitch.is_rigid());
}

FrameId Assembler::add_pitch_axis(FrameId hub, int number, const BladeDescription& blade) {
    const double undersling = d_.hub.teeter ? d_.hub.teeter->undersling : 0;
    const Mat3 azimuth = rot_z(2 * pi * (number - 1) / d_.blades), cone = rot_y(-blade.cone);
    const Placement root = Placement::translation({0, 0, -undersling}) * Placement::rotation(azimuth * cone) *
                           Placement::translation({d_.hub.radius, 0, 0});
    return tree.add_frame(hub, root, text("blade ", number, " pitch axis"));
}

// Axes with x along a direction; the others do not matter to what slides along x.
Mat3 axes_along(const Vec3& direction) {
    const Vec3 x = direction.normalized(), y = x.unitOrthogonal();
    return (Mat3() << x, y, cross<double>(x, y)).finished();
}

// The actuator slides on the hub; the rod closes the loop.
BodyId Assembler::add_linkage(FrameId pitch_axis, FrameId blade_side, int number, const PitchLinkage& linkage) {
    const std::string name = text("blade ", number, " pitch ");
    const Placement at_pin =
        Placement::translation(linkage.actuator_pin) * Placement::rotation(axes_along(linkage.direction));
    const FrameId line = tree.add_frame(pitch_axis, at_pin, name + "actuator line");
    const JointedFrame actuator =
        jointed(line, JointKind::prismatic, Axis::x, name + "actuator", {"pitch", number}, linkage.actuator);
    tree.weld(actuator.frame, {linkage.mass, Vec3::Zero(), Mat3::Zero()}, "pitch actuators");
    const FrameId pin = tree.add_frame(blade_side, Placement::translation(linkage.crank_pin), name + "crank pin");
    loops.add_distance({name + "rod", actuator.frame, pin, (linkage.crank_pin - linkage.actuator_pin).norm()});
    layout.pitch_actuators.push_back(actuator.body);
    return actuator.body;
}

// Blades that share a description share their damping, and so their elements.
CardanBeam Assembler::add_blade_beam(FrameId root, int number, const BladeDescription& blade) {
    const std::string name = text("blade ", number);
    for (std::size_t i = 0; i < layout.blades.size(); ++i)
        if (d_.blade_at(layout.blade_numbers[i]) == &blade)
            return add_cardan_beam(tree, forces, root, layout.blades[i], name, {"blade", number});
    const auto damping = damping_.blades.find(number);
    return add_cardan_beam(tree, forces, root, blade.line, name, {"blade", number},
                           damped(blade_beam_options(blade, options_),
                                  damping == damping_.blades.end() ? BeamDamping() : damping->second));
}

void Assembler::add_blade(FrameId hub, int number, const BladeDescription& blade, bool with_pitch_joint) {
    const std::string name = text("blade ", number);
    const FrameId pitch_axis = add_pitch_axis(hub, number, blade);
    FrameId root = pitch_axis;
    std::vector<BodyId> coordinates;
    if (with_pitch_joint) {
        const JointedFrame pitch =
            jointed(root, JointKind::revolute, Axis::x, name + " pitch", {"pitch", number}, blade.pitch);
        coordinates.push_back(pitch.body);
        layout.pitch.push_back(pitch.body);
        root = pitch.frame;
        if (blade.pitch_inertia > 0)
            tree.add_armature({name + " pitch inertia", blade.pitch_inertia, {{pitch.body, 1.0}}});
        if (blade.linkage) coordinates.push_back(add_linkage(pitch_axis, root, number, *blade.linkage));
    }
    if (options_.pitch_drives) {
        const JointedFrame drive = add_joint(tree, root, JointKind::revolute, Axis::x, name + " pitch drive",
                                             {"pitch", number}, Vec3::Zero(), CoordinateRole::prescribed);
        coordinates.push_back(drive.body);
        layout.pitch_drives.push_back(drive.body);
        root = drive.frame;
    }
    const double setting = options_.pitch + blade.pitch_setting;
    const FrameId axes = tree.add_frame(root, Placement::rotation(rot_x(-setting)), name + " root");
    const CardanBeam beam = add_blade_beam(axes, number, blade);
    if (blade.tip_mass > 0) {
        RigidInertia tip;
        tip.mass = blade.tip_mass;
        tree.weld(beam.tip(), tip, name);
    }
    for (const CardanBeam::Element& element : beam.elements)
        coordinates.insert(coordinates.end(), element.bodies.begin(), element.bodies.end());
    blades.push_back(coordinates);
    layout.blade_numbers.push_back(number);
    layout.blades.push_back(beam);
    layout.pitch_axes.push_back(pitch_axis);
    layout.blade_roots.push_back(axes);
    layout.pitch_settings.push_back(setting);
    keep(beam);
    std::vector<FrameId> points{hub};
    points.insert(points.end(), beam.nodes.begin(), beam.nodes.end());
    lines.push_back({"blade", number, points});
    if (blades.size() > 1) return;
    if (with_pitch_joint) parts.push_back({"pitch", pitch_axis, {}, {"blade pitch", "", ""}});
    parts.push_back({"blade", pitch_axis, {"blade extension", "", ""}, {"blade torsion", "blade flap", "blade edge"}});
}

}  // namespace cardan::turbines
