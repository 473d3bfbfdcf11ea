#include "turbines/yaml/windio.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/yaml/detail/windio_beams.hpp"

#include <algorithm>

namespace cardan::turbines {

WindioFile::WindioFile(YamlNode root) : root_(std::move(root)) {
    const auto given = find({"windIO_version"});
    if (!given) return;
    const std::string version = given->word();
    if (!version.starts_with("1") && !version.starts_with("2"))
        given->fail(text("version ", version, "; allowed: 1.x and 2.x"));
    version_ = version[0] - '0';
    if (version_ == 2) angle_ = units::degree;
}

std::optional<YamlNode> WindioFile::find(std::initializer_list<const char*> paths) const {
    for (const char* path : paths)
        if (std::optional<YamlNode> found = root_.find_path(path)) return found;
    return std::nullopt;
}

YamlNode WindioFile::get(std::initializer_list<const char*> paths) const {
    if (std::optional<YamlNode> found = find(paths)) return *std::move(found);
    std::string all;
    for (const char* path : paths) all += (all.empty() ? "" : " or ") + std::string(path);
    // As far as the first one goes.
    YamlNode at = root_;
    std::string_view rest = *paths.begin();
    while (std::optional<YamlNode> next = at.find(rest.substr(0, rest.find('.')))) {
        at = *std::move(next);
        rest.remove_prefix(std::min(rest.find('.'), rest.size() - 1) + 1);
    }
    at.fail(text("no ", all));
}

void WindioFile::note(const YamlNode& node, std::string value, std::string why) {
    const std::string& path = node.path();
    const auto is_there = [&](const FileNote& other) { return other.keyword == path && other.why == why; };
    if (std::any_of(notes.begin(), notes.end(), is_there)) return;
    notes.push_back({node.file(), node.line(), node.path(), std::move(value), std::move(why)});
}

namespace {

// In a node that was read, what was not.
void collect(const YamlNode& node, std::vector<FileNote>& out) {
    if (node.is_list())
        for (const YamlNode& item : node.items()) collect(item, out);
    if (!node.is_map()) return;
    for (const YamlNode& entry : node.entries())
        if (entry.was_read())
            collect(entry, out);
        else if (!entry.path().ends_with(".name"))
            out.push_back({entry.file(), entry.line(), entry.path(), "",
                           "not used: no part of the structure as it is modelled", FileNote::Kind::unused});
}

}  // namespace

std::vector<FileNote> WindioFile::unused() const {
    std::vector<FileNote> out;
    std::string others;
    for (const YamlNode& entry : root_.entries())
        if (!entry.was_read())
            others += (others.empty() ? "" : ", ") + entry.path();
        else if (entry.path() != "materials")  // of which others hold much
            collect(entry, out);
    if (!others.empty())
        out.push_back({root_.file(), 0, others, "",
                       "aerodynamics, control, costs, remarks: without meaning for the machine",
                       FileNote::Kind::unused});
    return out;
}

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

constexpr std::initializer_list<const char*> hub_mass{"components.hub.elastic_properties.mass",
                                                      "components.hub.elastic_properties_mb.system_mass"};
constexpr std::initializer_list<const char*> nacelle_mass{"components.drivetrain.elastic_properties.mass",
                                                          "components.nacelle.elastic_properties_mb.system_mass"};

class WindioReader {
public:
    explicit WindioReader(YamlNode root) : file_(std::move(root)) {}

    TurbineFile read() {
        refuse_incomplete();
        d_.name = file_.get({"name"}).word();
        const auto blades = file_.find({"assembly.number_of_blades"});
        d_.blades = blades ? blades->integer(1, 10) : 3;
        read_side();
        try {
            d_.tower.line = beam_line(windio_tower(file_));
            out_.tower_foot = tower_heights().front();
        } catch (const InputError& error) {
            file_.root().fail(error.what());
        }
        d_.tower.damping = windio_tower_damping(file_);
        const BeamTable blade = windio_blade(file_);
        d_.blade.line = beam_line(blade);
        d_.blade.damping = windio_blade_damping(file_);
        d_.blade.pitch = rigid_joint;
        d_.yaw = {rigid_joint, rigid_joint};
        read_foundation();
        read_hub();
        read_nacelle();
        read_drive_train();
        compare_sizes(blade.points.empty() ? blade.stations.back() : blade.points.back()(0));
        if (const auto speed =  // of versions 2.1; 1; 1 and 2.0
            file_.find({"control.rated_rotor_speed", "control.supervisory.maxOmega", "control.torque.VS_maxspd",
                        "control.max_rotor_speed"})) {
            out_.rotor_speed = d_.rotor_speed = not_negative(*speed) * file_.rotor_speed();
            out_.rotor_speed_source = speed->path();
        }
        for (FileNote& note : file_.notes) out_.notes.push_back(std::move(note));
        for (FileNote& note : file_.unused()) out_.notes.push_back(std::move(note));
        admit_unusual(out_, file_.root().file());
        return std::move(out_);
    }

private:
    // All that is missing at once: who supplies it wants to know all of it.
    void refuse_incomplete() const {
        const bool new_keys = file_.version() == 2;
        std::string lacking;
        const auto need = [&](const char* what, const char* remark, std::initializer_list<const char*> paths) {
            if (file_.find(paths)) return;
            lacking += text(lacking.empty() ? "" : "; ", what, " (", new_keys ? *paths.begin() : *(paths.end() - 1),
                            remark, ")");
        };
        need("stiffness and inertia of the blade's sections",
             ", with stiffness and inertia matrix: sections are not computed from layers",
             {"components.blade.structure.elastic_properties", "components.blade.elastic_properties",
              "components.blade.elastic_properties_mb", "components.blade.elastic_properties_mb.six_x_six"});
        need("mass of the hub", "", hub_mass);
        need("mass of nacelle and drive train", "", nacelle_mass);
        if (!lacking.empty())
            file_.root().fail(
                text("the model lacks: ", lacking,
                     "; remedy: a YAML file with these entries, read in addition (programs: --with FILE)"));
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
    void missing(const char* entry, const char* why) {
        out_.notes.push_back({file_.root().file(), 0, entry, "not there", why});
    }

    void read_hub() {
        d_.hub.radius = positive(file_.get({"components.hub.diameter", "components.hub.outer_shape_bem.diameter"})) / 2;
        // Away from the tower positive there, of upwind and downwind rotors.
        d_.blade.cone =
            away_ * small_angle(file_.get({"components.hub.cone_angle", "components.hub.outer_shape_bem.cone_angle"}));
        RigidInertia hub;
        hub.mass = not_negative(file_.get(hub_mass));
        if (const auto J = file_.find(
                {"components.hub.elastic_properties.inertia", "components.hub.elastic_properties_mb.system_inertia"}))
            hub.J = tensor(*J);
        if (const auto place = file_.find({"components.hub.elastic_properties.location",
                                           "components.hub.elastic_properties_mb.system_center_mass"}))
            hub.com = padded_vector(*place);
        hub.reduced = true;
        d_.hub.inertia = hub.in(Placement::rotation(beamdyn_axes()));  // x downwind along the shaft, z up
    }

    void read_nacelle() {
        NacelleDescription& n = d_.nacelle;
        // The rotor's end of the shaft up.
        const double uptilt = small_angle(
            file_.get({"components.drivetrain.outer_shape.uptilt", "components.nacelle.drivetrain.uptilt"}));
        const double overhang =
            file_.get({"components.drivetrain.outer_shape.overhang", "components.nacelle.drivetrain.overhang"})
                .number();
        const double height = file_
                                  .get({"components.drivetrain.outer_shape.distance_tt_hub",
                                        "components.nacelle.drivetrain.distance_tt_hub"})
                                  .number();
        n.tilt = -away_ * uptilt;
        n.overhang = -away_ * overhang / std::cos(uptilt);
        n.shaft_height = height - overhang * std::tan(uptilt);
        n.tilt_bearing = rigid_joint;
        RigidInertia& i = n.inertia;
        i.mass = not_negative(file_.get(nacelle_mass));
        if (const auto place = file_.find({"components.drivetrain.elastic_properties.location",
                                           "components.nacelle.elastic_properties_mb.system_center_mass"}))
            i.com = padded_vector(*place);
        const auto own = file_.find({"components.drivetrain.elastic_properties.inertia",
                                     "components.nacelle.elastic_properties_mb.system_inertia"});
        if (own)
            i.J = tensor(*own);
        else if (const auto about_top = file_.find({"components.nacelle.elastic_properties_mb.system_inertia_tt"}))
            i.J = tensor(*about_top) - i.mass * (i.com.squaredNorm() * Mat3::Identity() - i.com * i.com.transpose());
        i.reduced = true;
        if (const auto yaw = file_.find(
                {"components.yaw.elastic_properties.mass", "components.nacelle.elastic_properties_mb.yaw_mass"})) {
            RigidInertia bearing;
            bearing.mass = not_negative(*yaw);
            i = i + bearing;
            file_.note(*yaw, text(bearing.mass), "is part of the nacelle here, on the yaw axis at the tower top");
        }
    }

    // Of the tower's reference axis, above the ground or the still water.
    std::vector<double> tower_heights() const {
        return file_
            .get({"components.tower.reference_axis.z.values",
                  "components.tower.elastic_properties_mb.six_x_six.reference_axis.z.values",
                  "components.tower.outer_shape_bem.reference_axis.z.values"})
            .numbers();
    }

    // Some files hold the axes of another machine, which WISDEM stretches to the diameter of the rotor and the height
    // of the hub. Here the axes count.
    void compare_sizes(double blade) {
        const double diameter = 2 * (d_.hub.radius + blade) * std::cos(d_.blade.cone);
        const YamlNode above = file_.get(
            {"components.drivetrain.outer_shape.distance_tt_hub", "components.nacelle.drivetrain.distance_tt_hub"});
        const auto compare = [&](const char* path, double found, const char* what) {
            constexpr double close = 0.02;
            const auto given = file_.find({path});
            if (!given || !(given->number() > 0) || std::abs(found / given->number() - 1) < close) return;
            file_.note(*given, text(given->number()),
                       text("the axes in the file are taken as they are and make ", what, " of ", found,
                            " m; other programs stretch them to this"));
        };
        compare("assembly.rotor_diameter", diameter, "a diameter");
        compare("assembly.hub_height", tower_heights().back() + above.number(), "a height");
    }

    void read_drive_train() {
        DriveTrainDescription& t = d_.drive_train;
        const auto ratio =
            file_.find({"components.drivetrain.gearbox.gear_ratio", "components.nacelle.drivetrain.gear_ratio"});
        t.gear_ratio = ratio ? positive(*ratio) : 1;
        t.high_speed_shaft = t.main_shaft = rigid_joint;
        if (const auto k = file_.find({"components.drivetrain.gearbox.elastic_properties.torsional_stiffness",
                                       "components.drivetrain.elastic_properties.spring_constant",
                                       "components.nacelle.elastic_properties_mb.spring_constant"})) {
            t.main_shaft = {positive(*k)};
            if (const auto c = file_.find({"components.drivetrain.gearbox.elastic_properties.torsional_damping",
                                           "components.drivetrain.elastic_properties.damping_coefficient",
                                           "components.nacelle.elastic_properties_mb.damping_coefficient"}))
                t.main_shaft.damping = not_negative(*c);
        } else {
            missing("torsional stiffness of the drive train", "the drive train is rigid");
        }
        const auto J = file_.find({"components.drivetrain.generator.elastic_properties.inertia",
                                   "components.nacelle.generator.elastic_properties_mb.rotor_inertia"});
        if (J)
            t.generator_inertia = tensor(*J)(0, 0);
        else
            missing("inertia of the generator", "zero: to be set before the machine is assembled");
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
