#include "turbines/yaml/windio.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/yaml/detail/windio_beams.hpp"
#include "turbines/yaml/detail/windio_operation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan::turbines {

namespace {

// Entries xx, yy, zz and perhaps xy, xz, yz of a tensor.
Mat3 tensor(const YamlNode& node) {
    const std::vector<double> v = node.numbers();
    if (v.size() != 3 && v.size() != 6) node.fail(text(v.size(), " numbers; allowed: 3 or 6 (xx, yy, zz, xy, xz, yz)"));
    Mat3 J = Vec3(v[0], v[1], v[2]).asDiagonal();
    if (v.size() == 6) {
        J(0, 1) = J(1, 0) = v[3];
        J(0, 2) = J(2, 0) = v[4];
        J(1, 2) = J(2, 1) = v[5];
    }
    return J;
}

double not_negative(const YamlNode& node) {
    const double value = node.number();
    if (!(value >= 0)) node.fail(text(value, "; allowed: >= 0"));
    return value;
}
double positive(const YamlNode& node) {
    const double value = node.number();
    if (!(value > 0)) node.fail(text(value, "; allowed: > 0"));
    return value;
}

Vec3 padded_vector(const YamlNode& node) {
    if (!node.is_list()) return {node.number(), 0, 0};
    const std::vector<double> v = node.numbers();
    if (v.empty() || v.size() > 3) node.fail(text(v.size(), " numbers; allowed: 1 ... 3"));
    Vec3 out = Vec3::Zero();
    std::copy(v.begin(), v.end(), out.begin());
    return out;
}

using Paths = std::initializer_list<const char*>;
using Part = MissingEntry::Part;

// Version 2; version 1; and where files of either version have them as well.
constexpr Paths hub_mass{"components.hub.elastic_properties.mass", "components.hub.elastic_properties_mb.system_mass"};
constexpr Paths hub_inertia{"components.hub.elastic_properties.inertia",
                            "components.hub.elastic_properties_mb.system_inertia"};
constexpr Paths hub_place{"components.hub.elastic_properties.location",
                          "components.hub.elastic_properties_mb.system_center_mass"};
constexpr Paths nacelle_mass{"components.drivetrain.elastic_properties.mass",
                             "components.nacelle.elastic_properties_mb.system_mass",
                             "components.drivetrain.elastic_properties_mb.system_mass",
                             "components.nacelle.drivetrain.elastic_properties_mb.system_mass"};
constexpr Paths nacelle_inertia{"components.drivetrain.elastic_properties.inertia",
                                "components.nacelle.elastic_properties_mb.system_inertia",
                                "components.drivetrain.elastic_properties_mb.system_inertia",
                                "components.nacelle.drivetrain.elastic_properties_mb.system_inertia"};
constexpr Paths nacelle_inertia_about_top{"components.drivetrain.elastic_properties.inertia_tt",
                                          "components.nacelle.elastic_properties_mb.system_inertia_tt",
                                          "components.drivetrain.elastic_properties_mb.system_inertia_tt",
                                          "components.nacelle.drivetrain.elastic_properties_mb.system_inertia_tt"};
constexpr Paths nacelle_place{"components.drivetrain.elastic_properties.location",
                              "components.nacelle.elastic_properties_mb.system_center_mass",
                              "components.drivetrain.elastic_properties_mb.system_center_mass",
                              "components.nacelle.drivetrain.elastic_properties_mb.system_center_mass"};
constexpr Paths yaw_mass{"components.yaw.elastic_properties.mass", "components.nacelle.elastic_properties_mb.yaw_mass",
                         "components.drivetrain.elastic_properties_mb.yaw_mass",
                         "components.nacelle.drivetrain.elastic_properties_mb.yaw_mass"};
constexpr Paths shaft_stiffness{"components.drivetrain.gearbox.elastic_properties.torsional_stiffness",
                                "components.drivetrain.elastic_properties.spring_constant",
                                "components.nacelle.elastic_properties_mb.spring_constant",
                                "components.drivetrain.elastic_properties_mb.spring_constant"};
constexpr Paths shaft_damping{"components.drivetrain.gearbox.elastic_properties.torsional_damping",
                              "components.drivetrain.elastic_properties.damping_coefficient",
                              "components.nacelle.elastic_properties_mb.damping_coefficient",
                              "components.drivetrain.elastic_properties_mb.damping_coefficient"};
constexpr Paths nacelle_component{"components.drivetrain", "components.nacelle"};
constexpr Paths hub_height_above_tower{"components.drivetrain.outer_shape.distance_tt_hub",
                                       "components.nacelle.drivetrain.distance_tt_hub"};

class WindioReader {
public:
    explicit WindioReader(YamlNode root) : file_(std::move(root)) {}

    TurbineFile read() {
        d_.name = file_.get({"name"}).word();
        const auto blades = file_.find({"assembly.number_of_blades"});
        d_.blades = blades ? blades->integer(1, 10) : 3;
        read_side();
        read_tower();
        read_blade();
        d_.yaw = {rigid_joint, rigid_joint};
        read_foundation();
        read_hub();
        read_nacelle();
        read_drive_train();
        compare_sizes();
        read_windio_operation(file_, has_rotor() ? diameter() / 2 : 0, out_);
        for (FileNote& note : file_.notes) out_.notes.push_back(std::move(note));
        for (FileNote& note : file_.unused()) out_.notes.push_back(std::move(note));
        admit_unusual(out_, file_.root().file());
        for (MissingEntry& one : d_.missing) one.file = file_.root().file();
        return std::move(out_);
    }

private:
    void lack(Part part, std::string what, Paths paths, std::string value) {
        // The key of the file's own version.
        const char* key = paths.begin()[file_.version() == 2 ? 0 : 1];
        d_.missing.push_back({part, std::move(what), key, std::move(value)});
    }
    void lack_component(Part part, const char* what, const char* key) { d_.missing.push_back({part, what, key, {}}); }
    // Where the component begins.
    void note_missing(Paths component, const char* what, std::string why) {
        out_.notes.push_back({file_.root().file(), file_.get(component).line(), what, "not there", std::move(why)});
    }
    void zero(Paths component, const char* what, const char* effect) {
        note_missing(component, what, text("taken as zero: ", effect));
    }
    // One that no body can have is as good as none.
    void check(Part part, const char* what, const RigidInertia& inertia, Paths paths) {
        const auto given = file_.find(paths);
        try {
            inertia.check(what);
        } catch (const InputError& error) {
            if (!given) throw;
            lack(part,
                 text("inertia of the ", what, " that a body can have (that of line ", given->line(), ": ",
                      error.what(), ")"),
                 paths, "[JXX,JYY,JZZ]");
        }
    }

    void read_tower() {
        if (!file_.find({"components.tower"})) return lack_component(Part::tower, "the tower", "components.tower");
        try {
            d_.tower.line = beam_line(windio_tower(file_));
            out_.tower_base = tower_heights().front();
        } catch (const InputError& error) {
            file_.root().fail(error.what());
        }
        d_.tower.damping = windio_tower_damping(file_);
    }
    void read_blade() {
        d_.blade.pitch = rigid_joint;
        if (!file_.find({"components.blade"})) return lack_component(Part::blade, "the blades", "components.blade");
        if (windio_has_sections(file_)) {
            d_.blade.line = beam_line(windio_blade(file_));
            d_.blade.damping = windio_blade_damping(file_);
            return;
        }
        d_.blade.line.length = windio_blade_length(file_);
        d_.missing.push_back({Part::blade,
                              "stiffness and inertia matrices of the blade's sections, which are not computed from "
                              "layers",
                              file_.version() == 2 ? "components.blade.structure.elastic_properties"
                                                   : "components.blade.elastic_properties_mb.six_x_six",
                              {}});
    }

    void read_side() {
        const auto side = file_.find({"assembly.rotor_orientation"});
        if (!side || lower_case(side->word()) == "upwind") return;
        if (lower_case(side->word()) != "downwind")
            side->fail(text("'", side->word(), "'; allowed: upwind and downwind"));
        away_ = 1;
        file_.note(*side, side->word(),
                   "overhang, cone and tilt lead away from the tower, downwind; places of masses are taken with x "
                   "downwind, as of an upwind rotor");
    }
    // What the tower stands on is not read: its name is.
    void read_foundation() {
        d_.missing_foundation.where = "at the lower end of its reference axis";
        const auto components = file_.find({"components"});
        if (!components) return;
        for (const std::string& key : components->keys())
            for (const char* name : {"floating_platform", "monopile", "jacket"})
                if (key == name) d_.missing_foundation.name = key == "floating_platform" ? "floating platform" : key;
    }
    // Cone and tilt, in rad.
    double small_angle(const YamlNode& node) const {
        const double value = node.number() * file_.angle();
        if (!(std::abs(value) < pi / 4))
            node.fail(text(node.number(), "; allowed: below an eighth of a turn (", file_.unit_of_angle(), ")"));
        return value;
    }

    void read_hub() {
        if (!file_.find({"components.hub"})) return lack_component(Part::hub, "the hub", "components.hub");
        d_.hub.radius = positive(file_.get({"components.hub.diameter", "components.hub.outer_shape_bem.diameter"})) / 2;
        // Away from the tower positive there, of upwind and downwind rotors.
        d_.blade.cone =
            away_ * small_angle(file_.get({"components.hub.cone_angle", "components.hub.outer_shape_bem.cone_angle"}));
        RigidInertia hub;
        const auto mass = file_.find(hub_mass), J = file_.find(hub_inertia), place = file_.find(hub_place);
        if (mass)
            hub.mass = not_negative(*mass);
        else
            lack(Part::hub, "mass of the hub", hub_mass, "MASS_kg");
        if (J)
            hub.J = tensor(*J);
        else if (mass)
            zero({"components.hub"}, "inertia of the hub", "about the shaft it is small beside that of the blades");
        if (place)
            hub.com = padded_vector(*place);
        else if (mass)
            zero({"components.hub"}, "mass centre of the hub", "it is the rotor's centre");
        hub.reduced = true;
        check(Part::hub, "hub", hub, hub_inertia);
        d_.hub.inertia = hub.in(Placement::rotation(beamdyn_axes()));  // x downwind along the shaft, z up
    }

    bool has_nacelle() const { return file_.find(nacelle_component).has_value(); }

    void read_nacelle() {
        if (!has_nacelle())
            return lack_component(Part::nacelle, "nacelle and drive train",
                                  file_.version() == 2 ? "components.drivetrain" : "components.nacelle");
        NacelleDescription& n = d_.nacelle;
        // The rotor's end of the shaft up.
        const double uptilt =
            small_angle(file_.get({"components.drivetrain.outer_shape.uptilt", "components.nacelle.drivetrain.uptilt",
                                   "components.nacelle.drivetrain.uptilt_angle"}));
        const double overhang =
            file_.get({"components.drivetrain.outer_shape.overhang", "components.nacelle.drivetrain.overhang"})
                .number();
        const double height = file_.get(hub_height_above_tower).number();
        n.tilt = -away_ * uptilt;
        n.overhang = -away_ * overhang / std::cos(uptilt);
        n.shaft_height = height - overhang * std::tan(uptilt);
        n.tilt_bearing = rigid_joint;
        read_nacelle_inertia(n.inertia);
        if (const auto yaw = file_.find(yaw_mass)) {
            RigidInertia bearing;
            bearing.mass = not_negative(*yaw);
            n.inertia = n.inertia + bearing;
            file_.note(*yaw, text(bearing.mass), "is part of the nacelle here, on the yaw axis at the tower top");
        }
    }
    void read_nacelle_inertia(RigidInertia& i) {
        const auto mass = file_.find(nacelle_mass), place = file_.find(nacelle_place),
                   own = file_.find(nacelle_inertia), about_top = file_.find(nacelle_inertia_about_top);
        if (mass)
            i.mass = not_negative(*mass);
        else
            lack(Part::nacelle, "mass of nacelle and drive train", nacelle_mass, "MASS_kg");
        if (place)
            i.com = padded_vector(*place);
        else if (mass)
            zero(nacelle_component, "mass centre of the nacelle", "it is the tower top");
        if (own)
            i.J = tensor(*own);
        else if (about_top && mass)
            i.J = tensor(*about_top) - i.mass * (i.com.squaredNorm() * Mat3::Identity() - i.com * i.com.transpose());
        else if (mass)
            zero(nacelle_component, "inertia of the nacelle", "about the tower's axis the rotor has most of it");
        i.reduced = true;
        check(Part::nacelle, "nacelle", i, own ? nacelle_inertia : nacelle_inertia_about_top);
    }

    // Of the tower's reference axis, above the ground or the still water.
    std::vector<double> tower_heights() const {
        return file_
            .get({"components.tower.reference_axis.z.values",
                  "components.tower.elastic_properties_mb.six_x_six.reference_axis.z.values",
                  "components.tower.outer_shape_bem.reference_axis.z.values"})
            .numbers();
    }

    bool has_rotor() const { return file_.find({"components.hub"}) && file_.find({"components.blade"}); }
    double diameter() { return 2 * (d_.hub.radius + windio_blade_length(file_)) * std::cos(d_.blade.cone); }
    // Some files hold the axes of another machine, which WISDEM stretches to the diameter of the rotor and the height
    // of the hub. Here the axes count.
    void compare_sizes() {
        const auto compare = [&](const char* path, double found, const char* what) {
            constexpr double close = 0.02;
            const auto given = file_.find({path});
            if (!given || !(given->number() > 0) || std::abs(found / given->number() - 1) < close) return;
            file_.note(*given, text(given->number()),
                       text("the axes in the file are taken as they are and make ", what, " of ", found,
                            " m; other programs stretch them to this"));
        };
        if (has_rotor()) compare("assembly.rotor_diameter", diameter(), "a diameter");
        if (file_.find({"components.tower"}) && has_nacelle())
            compare("assembly.hub_height", tower_heights().back() + file_.get(hub_height_above_tower).number(),
                    "a height");
    }

    void read_drive_train() {
        DriveTrainDescription& t = d_.drive_train;
        const auto ratio =
            file_.find({"components.drivetrain.gearbox.gear_ratio", "components.nacelle.drivetrain.gear_ratio"});
        t.gear_ratio = ratio ? positive(*ratio) : 1;
        t.high_speed_shaft = t.main_shaft = rigid_joint;
        if (!has_nacelle()) return;
        const auto k = file_.find(shaft_stiffness), c = file_.find(shaft_damping);
        if (k && not_negative(*k) > 0)
            t.main_shaft = {k->number(), c ? not_negative(*c) : 0};
        else
            note_missing(nacelle_component, "torsional stiffness of the drive train", "the drive train is rigid");
        const auto J = file_.find({"components.drivetrain.generator.elastic_properties.inertia",
                                   "components.nacelle.generator.elastic_properties_mb.rotor_inertia",
                                   "components.drivetrain.generator.elastic_properties_mb.rotor_inertia"});
        if (J)
            t.generator_inertia = tensor(*J)(0, 0);
        else if (t.main_shaft.is_rigid())
            zero(nacelle_component, "inertia of the generator",
                 "behind a gearbox it may be a tenth of the rotor's: --generator-inertia");
        else
            note_missing(nacelle_component, "inertia of the generator",
                         "zero: to be set before the machine is assembled (--generator-inertia)");
    }

    WindioFile file_;
    double away_ = -1;  ///< from the tower to the rotor, downwind: -1 upwind of it, 1 downwind
    TurbineFile out_;
    TurbineDescription& d_ = out_.description;
};

}  // namespace

TurbineFile parse_windio(const std::string& text, const std::string& file,
                         const std::vector<ModelAddition>& additions) {
    TurbineFile out = WindioReader(YamlNode::parse(text, file, additions)).read();
    out.description.source = text;
    for (const ModelAddition& addition : additions)
        out.description.source += cardan::text("\n# ", addition.name, "\n", addition.text);
    return out;
}

TurbineFile read_windio(const std::filesystem::path& path, const std::vector<ModelAddition>& additions) {
    return parse_windio(text_file(path), path.string(), additions);
}

}  // namespace cardan::turbines
