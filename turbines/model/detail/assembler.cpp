#include "turbines/model/detail/assembler.hpp"

#include "mbs/base/error.hpp"

namespace cardan::turbines {

namespace {

CardanBeamOptions beam_options(const AssemblyOptions& options, int elements,
                               const std::optional<CardanBeamOptions>& full, const BeamDamping& damping) {
    CardanBeamOptions beam;
    beam.elements = elements;
    beam.delta = options.delta;
    beam.partition = options.partition;
    if (full) beam = *full;
    beam.damping = damping;
    return beam;
}

bool is_empty(const BeamDamping& damping) {
    return !damping.needs_modes() && damping.time_constants == BeamDamping().time_constants;
}

}  // namespace

Assembler::Assembler(const TurbineDescription& description, const AssemblyOptions& options, const PartDamping& damping)
    : d_(description), options_(options), damping_(damping) {
    if (d_.blades < 1) throw InputError(d_.name, "number of blades", d_.blades, ">= 1");
    if (!(std::isfinite(options.pitch))) throw InputError(d_.name, "pitch [rad]", options.pitch, "finite");
    require_positive(d_.name, "hub radius [m]", d_.hub.radius);
    require_positive(d_.name, "overhang [m]", d_.nacelle.overhang);
    require_positive(d_.name, "gear ratio", d_.drive_train.gear_ratio);
    require_positive(d_.name, "generator inertia [kg m^2]", d_.drive_train.generator_inertia);
    require_not_negative(d_.name, "gearbox inertia [kg m^2]", d_.drive_train.gearbox_inertia);
    require_not_negative(d_.name, "tower damping ratio", d_.tower.first_mode_damping);
    require_not_negative(d_.name, "blade damping ratio", d_.blade.first_flap_damping);
    for (int elements : {options.tower_elements, options.blade_elements})
        if (elements > 1000) throw InputError(d_.name, "number of elements", elements, "1 ... 1000");
    check("tower", options.tower_beam);
    check("blade", options.blade_beam);
    forces.set_gravity(options.gravity);
    layout.pitch_setting = options.pitch;
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
    const FrameId hub = options_.shaft_beam ? add_drive_train_with_beam(shaft) : add_drive_train(shaft);
    tree.weld(hub, d_.hub.inertia, "hub");
    for (int k = 1; k <= d_.blades; ++k) add_blade(hub, k, !d_.blade.pitch.is_rigid());
    if (layout.platform) add_water_forces(forces, tree, *layout.platform, *options_.platform, warnings);
    add_tower_axes();
}

void Assembler::one_blade() {
    const FrameId shaft = Tree::base();
    const JointedFrame spinner = add_joint(tree, shaft, JointKind::revolute, Axis::x, "spin", {"rotor"});
    spin = spinner.body;
    layout.azimuth = {{spinner.body, 1.0}};
    layout.shaft = shaft;
    layout.hub = hub_frame = tree.add_frame(spinner.frame, Placement::rotation(hub_axes()), "hub");
    add_blade(hub_frame, 1, false);
}

void Assembler::check(const char* part, const std::optional<CardanBeamOptions>& beam) const {
    if (!beam) return;
    if (beam->elements > 1000) throw InputError(d_.name, "number of elements", beam->elements, "1 ... 1000");
    if (!is_empty(beam->damping))
        throw InputError(d_.name, text("damping among the options of the elements of the ", part), "given",
                         "none: it belongs into the description");
}

FrameId Assembler::past_joint(FrameId carrier, JointKind kind, Axis axis, const std::string& name,
                              const PartLabel& label, const Spring& law) {
    return law.is_rigid() ? carrier : sprung_joint(carrier, kind, axis, name, label, law).frame;
}

JointedFrame Assembler::sprung_joint(FrameId carrier, JointKind kind, Axis axis, const std::string& name,
                                     const PartLabel& label, const Spring& law, const Vec3& offset) {
    const JointedFrame joint = add_joint(tree, carrier, kind, axis, name, label, offset);
    const Spring s = spring(law);
    forces.add_spring(name, joint.body, s.stiffness, s.damping);
    return joint;
}

void Assembler::add_platform() {
    if (!options_.platform) return;
    const PlatformFrames platform = turbines::add_platform(tree, *options_.platform);
    layout.platform = platform.base;
    foundation_ = platform.tower_foot;
    if (platform.line.size() > 1) lines.push_back({"platform", 0, platform.line});
    parts.push_back({"platform",
                     Tree::base(),
                     {"platform surge", "platform sway", "platform heave"},
                     {"platform roll", "platform pitch", "platform yaw"}});
}

FrameId Assembler::add_tower() {
    const Mat3 upward = axis_rotation(Axis::y);  // x -> z, y -> x, z -> y
    const FrameId foot = tree.add_frame(foundation_, Placement::rotation(upward), "tower foot");
    const CardanBeam beam =
        add_cardan_beam(tree, forces, foot, d_.tower.line, "tower", {"tower"},
                        beam_options(options_, options_.tower_elements, options_.tower_beam, damping_.tower));
    keep(beam);
    lines.push_back({"tower", 0, beam.nodes});
    layout.tower = beam;
    layout.tower_foot = foot;
    return layout.tower_top = tree.add_frame(beam.tip(), Placement::rotation(upward.transpose()), "tower top");
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
        const JointedFrame yaw = sprung_joint(at, JointKind::revolute, Axis::z, "yaw", label, d_.yaw.rotation);
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
        sprung_joint(nacelle, JointKind::revolute, Axis::y, "tilt", {"tilt"}, d_.nacelle.tilt_bearing, centre);
    parts.push_back({"tilt", foundation_, {}, {"", "rotor tilt", ""}});
    return tree.add_frame(tilt.frame, Placement::rotation(rot_y(d_.nacelle.tilt)), "shaft");
}

// Generator and gearbox are armatures about the shaft; the coordinates are relative to each other.
FrameId Assembler::add_generator_and_gearbox(FrameId shaft) {
    const DriveTrainDescription& t = d_.drive_train;
    const double squared = t.gear_ratio * t.gear_ratio;
    const PartLabel label{"drive train"};
    const JointedFrame generator = add_joint(tree, shaft, JointKind::revolute, Axis::x, "generator azimuth", label);
    spin = generator.body;
    layout.generator = generator.body;
    layout.gear_ratio = t.gear_ratio;
    layout.shaft = shaft;
    layout.azimuth = {{generator.body, 1.0}};
    FrameId at = generator.frame;
    if (!t.high_speed_shaft.is_rigid()) {
        const JointedFrame gearbox =
            sprung_joint(at, JointKind::revolute, Axis::x, "high-speed shaft twist", label,
                         {t.high_speed_shaft.stiffness * squared, t.high_speed_shaft.damping * squared});
        layout.azimuth.emplace_back(gearbox.body, 1.0);
        at = gearbox.frame;
    }
    tree.add_armature({"generator", t.generator_inertia * squared, {{generator.body, 1.0}}});
    if (t.gearbox_inertia > 0) tree.add_armature({"gearbox", t.gearbox_inertia, layout.azimuth});
    parts.push_back({"drive train", shaft, {}, {"drive-train torsion", "", ""}});
    return at;
}

FrameId Assembler::add_drive_train(FrameId shaft) {
    const FrameId gearbox = add_generator_and_gearbox(shaft);
    const Placement rotor_centre = Placement::translation({-d_.nacelle.overhang, 0, 0});
    FrameId at = gearbox;
    if (!d_.drive_train.main_shaft.is_rigid()) {
        const JointedFrame hub = sprung_joint(gearbox, JointKind::revolute, Axis::x, "main shaft twist",
                                              {"drive train"}, d_.drive_train.main_shaft);
        layout.azimuth.emplace_back(hub.body, 1.0);
        at = hub.frame;
    }
    return add_hub_frame(shaft, tree.add_frame(at, rotor_centre, "rotor centre"));
}

FrameId Assembler::add_drive_train_with_beam(FrameId shaft) {
    if (d_.drive_train.main_shaft.is_rigid())
        throw InputError(d_.name, "torsional stiffness of the main shaft as a beam [N m/rad]",
                         d_.drive_train.main_shaft.stiffness, "finite");
    const FrameId gearbox = add_generator_and_gearbox(shaft);
    EngineeringSection section;
    section.mass = options_.shaft_beam->mass;
    section.EI_flap = section.EI_edge = options_.shaft_beam->EI;
    section.GJ = d_.drive_train.main_shaft.stiffness * d_.nacelle.overhang;
    // The beam runs upwind: x reversed.
    const FrameId start = tree.add_frame(gearbox, Placement::rotation(rot_z(pi)), "shaft start");
    const BeamLine line = uniform_beam(d_.nacelle.overhang, section, "main shaft");
    const CardanBeamOptions beam_option = beam_options(options_, 1, std::nullopt, {});
    const CardanBeam beam = add_cardan_beam(tree, forces, start, line, "main shaft", {"drive train"}, beam_option);
    const auto& e = beam.elements.front();
    if (options_.joint_damping)
        forces.add_spring("main shaft damper", e.bodies[2], 0, d_.drive_train.main_shaft.damping);
    layout.azimuth.emplace_back(e.bodies[2], -1.0);        // torsion, about the axis of the beam
    rotating_pairs.push_back({e.bodies[0], e.bodies[1]});  // (ay1, az1)
    rotating_pairs.push_back({e.bodies[4], e.bodies[3]});  // (ay2, az2)
    parts.back().rotation = {"drive-train torsion", "shaft bending", "shaft bending"};
    return add_hub_frame(shaft, tree.add_frame(beam.tip(), Placement::rotation(rot_z(pi)), "rotor centre"));
}

FrameId Assembler::add_hub_frame(FrameId shaft, FrameId rotor_centre) {
    layout.hub = hub_frame = tree.add_frame(rotor_centre, Placement::rotation(hub_axes()), "hub");
    lines.push_back({"shaft", 0, {tree.frame("tower top"), shaft, hub_frame}});
    return hub_frame;
}

void Assembler::add_blade(FrameId hub, int number, bool with_pitch_joint) {
    const std::string name = text("blade ", number);
    const Mat3 azimuth = rot_z(2 * pi * (number - 1) / d_.blades), cone = rot_y(-d_.blade.cone);
    const Placement root_pose = Placement::rotation(azimuth * cone) * Placement::translation({d_.hub.radius, 0, 0});
    FrameId root = tree.add_frame(hub, root_pose, name + " pitch axis");
    layout.pitch_axes.push_back(root);
    std::vector<BodyId> coordinates;
    if (with_pitch_joint) {
        const JointedFrame pitch =
            sprung_joint(root, JointKind::revolute, Axis::x, name + " pitch", {"pitch", number}, d_.blade.pitch);
        coordinates.push_back(pitch.body);
        layout.pitch.push_back(pitch.body);
        root = pitch.frame;
    }
    const FrameId axes = tree.add_frame(root, Placement::rotation(rot_x(-options_.pitch)), name + " root");
    const CardanBeam beam =
        add_cardan_beam(tree, forces, axes, d_.blade.line, name, {"blade", number},
                        beam_options(options_, options_.blade_elements, options_.blade_beam, damping_.blade));
    for (const CardanBeam::Element& element : beam.elements)
        coordinates.insert(coordinates.end(), element.bodies.begin(), element.bodies.end());
    blades.push_back(coordinates);
    layout.blades.push_back(beam);
    layout.blade_roots.push_back(axes);
    keep(beam);
    std::vector<FrameId> points{hub};
    points.insert(points.end(), beam.nodes.begin(), beam.nodes.end());
    lines.push_back({"blade", number, points});
    if (number > 1) return;
    const FrameId in_plane = tree.frame(name + " pitch axis");
    if (with_pitch_joint) parts.push_back({"pitch", in_plane, {}, {"blade pitch", "", ""}});
    parts.push_back({"blade", in_plane, {"blade extension", "", ""}, {"blade torsion", "blade flap", "blade edge"}});
}

}  // namespace cardan::turbines
