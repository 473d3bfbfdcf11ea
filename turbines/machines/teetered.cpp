#include "turbines/machines/teetered.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "mbs/model/summary.hpp"
#include "turbines/readers/csv.hpp"
#include "turbines/readers/detail/embedded_data.hpp"

#include <limits>

namespace cardan::turbines {

namespace {

constexpr auto teetered_table = "teetered.csv";

RigidInertia on_shaft(const CsvQuantities& q, const char* mass, const char* centre, const Vec3& along,
                      const Vec3& moments) {
    RigidInertia body;
    body.mass = q.number(mass, "kg");
    body.com = q.number(centre, "m") * along;
    body.J = moments.asDiagonal();
    return body;
}

TeeteredDescription describe_teetered(const CsvQuantities& q) {
    TeeteredDescription d;
    d.name = "two-bladed teetered machine (Lee, Hodges, Patil 2002)";
    d.rotor_speed = q.number("rotor_speed", "rad/s");

    const auto stiffness = [&](const char* name) { return q.number(name, "N m^2"); };
    EngineeringSection& t = d.tower.section;
    d.tower.length = q.number("tower_length", "m");
    t.mass = q.number("tower_mass_per_length", "kg/m");
    t.EI_flap = stiffness("tower_bending_stiffness_lateral");
    t.EI_edge = stiffness("tower_bending_stiffness_fore_aft");
    t.GJ = stiffness("tower_torsion_stiffness");
    t.j_flap = q.number("tower_inertia_lateral", "kg m");
    t.j_edge = q.number("tower_inertia_fore_aft", "kg m");

    const auto nacelle = q.numbers("nacelle_inertia_roll_nod_yaw", "kg m^2", 3),
               shaft = q.numbers("shaft_inertia_axial_lateral", "kg m^2", 2),
               hub = q.numbers("hub_inertia_teeter_shaft_spanwise", "kg m^2", 3);
    d.yaw = {q.number("yaw_stiffness", "N m/rad"), q.number("yaw_damping", "N m s/rad")};
    d.nacelle = on_shaft(q, "nacelle_mass", "nacelle_centre_from_yaw_axis", Vec3::UnitX(),
                         {nacelle[0], nacelle[1], nacelle[2]});
    d.nacelle.reduced = true;  // yaw only
    d.shaft_height = q.number("shaft_height", "m");
    d.tilt = q.number("tilt", "deg") * units::degree;
    d.overhang = -q.number("yaw_axis_to_teeter_axis", "m");
    d.shaft = on_shaft(q, "shaft_mass", "shaft_centre_from_yaw_axis", Vec3::UnitX(), {shaft[0], shaft[1], shaft[1]});

    d.hub.inertia = on_shaft(q, "hub_mass", "hub_centre_from_teeter_axis", Vec3::UnitZ(), {hub[2], hub[0], hub[1]});
    d.hub.root_arm = q.number("root_arm", "m");
    d.hub.undersling = q.number("undersling", "m");
    d.hub.delta3 = q.number("delta3", "deg") * units::degree;
    d.hub.cone = q.number("cone", "deg") * units::degree;
    d.hub.teeter = {q.number("teeter_stiffness", "N m/rad"), q.number("teeter_damping", "N m s/rad")};

    EngineeringSection& b = d.blade.section;
    d.blade.length = q.number("blade_length", "m");
    b.mass = q.number("blade_mass_per_length", "kg/m");
    b.EI_flap = stiffness("blade_bending_stiffness_flap");
    b.EI_edge = stiffness("blade_bending_stiffness_lag");
    b.GJ = stiffness("blade_torsion_stiffness");
    b.j_flap = q.number("blade_inertia_flap", "kg m");
    b.j_edge = q.number("blade_inertia_lag", "kg m");
    return d;
}

}  // namespace

TeeteredDescription teetered_description() {
    TeeteredDescription d = describe_teetered(CsvQuantities::parse(embedded_data(teetered_table), teetered_table));
    d.source = embedded_data(teetered_table);
    return d;
}

TeeteredDescription teetered_description(const std::filesystem::path& folder) {
    const std::filesystem::path path = folder / teetered_table;
    TeeteredDescription d = describe_teetered(CsvQuantities::read(path));
    d.source = text_file(path);
    return d;
}

TeeteredDescription with_tower_rigidity(TeeteredDescription d, double ratio) {
    require_positive(d.name, "ratio of tower to blade rigidity", ratio);
    d.tower.section.EI_edge = ratio * d.blade.section.EI_flap;
    d.tower.section.EI_flap = ratio * d.blade.section.EI_edge;
    d.tower.section.GJ = ratio * d.blade.section.GJ;
    return d;
}

// Builds the tree from the ground up and remembers what the rotor map needs.
class TeeteredAssembler {
public:
    TeeteredAssembler(const TeeteredDescription& description, const TeeteredOptions& options)
        : d_(description), options_(options) {
        check();
        forces.set_gravity(options.gravity);
    }

    void whole_machine() {
        const FrameId top = options_.rigid_tower ? add_rigid_tower() : add_tower();
        const FrameId centre = add_shaft(add_yaw_and_nacelle(top));
        const FrameId hub = add_teeter(centre);
        lines.push_back({"shaft", 0, {top, tree.frame("shaft"), hub}});
        for (int k = 1; k <= 2; ++k) add_blade(hub, k);
    }

    void one_blade() {
        rotor_centre = add_spin(Tree::base(), Vec3::Zero());
        add_blade(rotor_centre, 1);
    }

    Tree tree;
    ForceSet forces;
    BodyId spin;
    FrameId rotor_centre;
    std::vector<BodyId> odd;
    std::vector<std::vector<BodyId>> blades;
    std::vector<PartAxes> parts;
    std::vector<Polyline> lines;
    std::vector<std::string> warnings;

private:
    void check() const {
        const TeeteredHubDescription& h = d_.hub;
        require_not_negative(d_.name, "root arm [m]", h.root_arm);
        finite("rotor speed [rad/s]", d_.rotor_speed);
        finite("overhang [m]", d_.overhang);
        finite("shaft height [m]", d_.shaft_height);
        finite("undersling [m]", h.undersling);
        for (const auto& [quantity, angle] :
             {std::pair{"tilt [rad]", d_.tilt}, std::pair{"cone [rad]", h.cone}, std::pair{"delta-3 [rad]", h.delta3}})
            if (!(std::abs(angle) < pi / 2))
                throw InputError(d_.name, quantity, angle, "between -pi/2 and pi/2 (given in degrees?)");
        if (!options_.rigid_tower) check_beam("tower", d_.tower, options_.tower);
        check_beam("blade", d_.blade, options_.blade);
    }
    void finite(const char* quantity, double value) const {
        if (!std::isfinite(value)) throw InputError(d_.name, quantity, value, "finite");
    }
    static void check_beam(const char* name, const PrismaticBeam& beam, const CardanBeamOptions& options) {
        if (options.elements > 1000) throw InputError(name, "number of elements", options.elements, "1 ... 1000");
        if (options.extension && std::isinf(beam.section.EA))
            throw InputError(name, "free extension with EA [N]", beam.section.EA, "finite EA, or extension condensed");
    }

    CardanBeam add_beam(FrameId root, const PrismaticBeam& beam, const std::string& name, const PartLabel& label,
                        const CardanBeamOptions& options) {
        const BeamLine line = uniform_beam(beam.length, beam.section, label.part);
        CardanBeam added = add_cardan_beam(tree, forces, root, line, name, label, options);
        warnings.insert(warnings.end(), added.warnings.begin(), added.warnings.end());
        return added;
    }

    FrameId add_tower() {
        const Mat3 upward = axis_rotation(Axis::y);  // x -> z, y -> x, z -> y
        const FrameId foot = tree.add_frame(Tree::base(), Placement::rotation(upward), "tower foot");
        const CardanBeam beam = add_beam(foot, d_.tower, "tower", {"tower"}, options_.tower);
        parts.push_back({"tower", Tree::base(), {}, {"tower side-side", "tower fore-aft", "tower torsion"}});
        lines.push_back({"tower", 0, beam.nodes});
        return tree.add_frame(beam.tip(), Placement::rotation(upward.transpose()), "tower top");
    }

    FrameId add_rigid_tower() {
        const double length = d_.tower.length;
        require_positive("tower", "length [m]", length);
        RigidInertia rod;
        rod.mass = d_.tower.mass();
        rod.com = {0, 0, length / 2};
        rod.J = Vec3(1, 1, 0).asDiagonal() * (rod.mass * length * length / 12);
        tree.weld(Tree::base(), rod, "tower");
        const FrameId top = tree.add_frame(Tree::base(), Placement::translation({0, 0, length}), "tower top");
        lines.push_back({"tower", 0, {Tree::base(), top}});
        return top;
    }

    FrameId sprung_joint(FrameId carrier, Axis axis, const std::string& name, const Spring& spring,
                         CoordinateRole role = CoordinateRole::free) {
        const JointedFrame joint =
            add_joint(tree, carrier, JointKind::revolute, axis, name, {name}, Vec3::Zero(), role);
        forces.add_spring(name, joint.body, spring.stiffness, options_.joint_damping ? spring.damping : 0.0);
        return joint.frame;
    }

    FrameId add_yaw_and_nacelle(FrameId top) {
        const FrameId yawing = sprung_joint(top, Axis::z, "yaw", d_.yaw);
        tree.weld(yawing, d_.nacelle, "nacelle");
        parts.push_back({"yaw", Tree::base(), {}, {"", "", "rotor yaw"}});
        return tree.add_frame(yawing, {}, "nacelle");
    }

    // The shaft with its spin; returns the frame where it meets the teeter axis, hub axes.
    FrameId add_shaft(FrameId nacelle) {
        const Placement on_tower_axis{rot_y(d_.tilt), {0, 0, d_.shaft_height}};
        rotor_centre = add_spin(tree.add_frame(nacelle, on_tower_axis, "shaft"), Vec3(-d_.overhang, 0, 0));
        return rotor_centre;
    }

    FrameId add_spin(FrameId shaft, const Vec3& centre) {
        const Mat3 along = axis_rotation(Axis::x);
        BodySpec spec;
        spec.name = "rotor azimuth";
        spec.inboard = shaft;
        spec.placement = Placement::rotation(along);
        spec.coordinate.part = "rotor";
        spec.coordinate.role = options_.spin;
        spin = tree.add_body(spec);
        const FrameId spinning =
            tree.add_frame(tree.frame_of(spin), Placement::rotation(along.transpose()), "spinning shaft");
        tree.weld(spinning, d_.shaft, "shaft");
        return tree.add_frame(spinning, {hub_axes(), centre}, "rotor centre");
    }

    FrameId add_teeter(FrameId centre) {
        const FrameId axis = tree.add_frame(centre, Placement::rotation(rot_z(-d_.hub.delta3)), "teeter axis");
        const FrameId turned = sprung_joint(axis, Axis::y, "teeter", d_.hub.teeter,
                                            options_.teeter_locked ? CoordinateRole::driven : CoordinateRole::free);
        if (!options_.teeter_locked) odd.push_back(tree.body("teeter"));
        const FrameId hub = tree.add_frame(turned, Placement::rotation(rot_z(d_.hub.delta3)), "hub");
        tree.weld(hub, d_.hub.inertia, "hub");
        parts.push_back({"teeter", centre, {}, {"", "teeter", ""}});
        return hub;
    }

    void add_blade(FrameId hub, int number) {
        const std::string name = text("blade ", number);
        const Placement pose = Placement::translation({0, 0, -d_.hub.undersling}) *
                               Placement::rotation(rot_z(pi * (number - 1)) * rot_y(-d_.hub.cone)) *
                               Placement::translation({d_.hub.root_arm, 0, 0});
        const FrameId root = tree.add_frame(hub, pose, name + " root");
        const CardanBeam beam = add_beam(root, d_.blade, name, {"blade", number}, options_.blade);
        blades.emplace_back();
        for (const CardanBeam::Element& element : beam.elements)
            blades.back().insert(blades.back().end(), element.bodies.begin(), element.bodies.end());
        std::vector<FrameId> points{hub};
        points.insert(points.end(), beam.nodes.begin(), beam.nodes.end());
        lines.push_back({"blade", number, points});
        if (number == 1)
            parts.push_back(
                {"blade", root, {"blade extension", "", ""}, {"blade torsion", "blade flap", "blade edge"}});
    }

    const TeeteredDescription& d_;
    const TeeteredOptions& options_;
};

TeeteredTurbine::TeeteredTurbine(const TeeteredAssembler& a, const std::string& name,
                                 const TeeteredDescription& description, const std::string& settings)
    : tree_(std::make_shared<const Tree>(a.tree)),
      system_(std::make_shared<const System>(a.tree, a.forces)),
      source_(description.source),
      warnings_(a.warnings) {
    const Model& model = system_->model;
    rotor_.machine = name;
    rotor_.spin = model.index(a.spin);
    rotor_.hub = a.rotor_centre;
    for (const std::vector<BodyId>& blade : a.blades) {
        rotor_.blades.emplace_back();
        for (BodyId body : blade) rotor_.blades.back().push_back(model.index(body));
    }
    rotor_.parts = a.parts;
    rotor_.lines = a.lines;
    for (BodyId body : a.odd) odd_coordinates_.push_back(model.index(body));
    rotor_.description =
        text(summary(), "\nassembled with ", settings, "\n\nread from (before changes made in a program)\n", source_,
             "\n\nthe machine that was computed\n", description_text(description));
}

std::string TeeteredTurbine::summary() const {
    std::string out = text(rotor_.machine, "\n", cardan::summary(*tree_));
    for (const std::string& warning : warnings_) out += text("\nwarning: ", warning, "\n");
    return out;
}

namespace {

std::string beam_settings(const CardanBeamOptions& o) {
    return text(o.boundaries.empty() ? o.elements : static_cast<int>(o.boundaries.size()) - 1, " elements (",
                places_hinges(o.partition) ? std::string() : text("delta ", o.hinge_delta(), ", "),
                partition_name(o.partition), ", extension ", o.extension ? "free" : "condensed", ", torsion ",
                o.torsion ? "free" : "condensed", ", armatures bending ", o.bending_armature, ", torsion ",
                o.torsion_armature, ")");
}

// The options of an assembly in words.
std::string settings(const TeeteredOptions& o) {
    return text("tower ", o.rigid_tower ? std::string("rigid") : beam_settings(o.tower), ", blades ",
                beam_settings(o.blade), ", gravity (", o.gravity(0), ", ", o.gravity(1), ", ", o.gravity(2),
                ") m/s^2, joint damping ", o.joint_damping ? "on" : "off", ", teeter ",
                o.teeter_locked ? "locked" : "free", ", rotor speed ",
                o.spin == CoordinateRole::driven ? "prescribed" : "free");
}

}  // namespace

TeeteredTurbine assemble(const TeeteredDescription& description, const TeeteredOptions& options) {
    TeeteredAssembler assembler(description, options);
    assembler.whole_machine();
    return {assembler, description.name, description, settings(options)};
}

TeeteredTurbine isolated_blade(const TeeteredDescription& description, const TeeteredOptions& options) {
    TeeteredAssembler assembler(description, options);
    assembler.one_blade();
    return {assembler, description.name + ", isolated blade", description, settings(options)};
}

}  // namespace cardan::turbines
