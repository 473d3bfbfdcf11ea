#include "examples/shared/machine_file.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/machines/nrel5mw.hpp"
#include "turbines/machines/oc3_hywind.hpp"
#include "turbines/machines/teetered.hpp"
#include "turbines/machines/wt600_operation.hpp"
#include "turbines/readers/openfast.hpp"
#include "turbines/yaml/description.hpp"
#include "turbines/yaml/windio.hpp"

#include <array>
#include <iostream>

namespace cardan::program {

namespace {

MachineFile built_in(turbines::TurbineDescription description, double rotor_speed,
                     std::function<turbines::AssemblyOptions(int, int)> beams) {
    MachineFile machine;
    machine.file.yaw_drive = description.yaw.rotation;
    machine.file.dofs.generator = description.drive_train.spin == CoordinateRole::free;
    machine.file.description = std::move(description);
    machine.file.rotor_speed = rotor_speed;
    machine.beams = std::move(beams);
    return machine;
}

MachineFile wt600_machine() {
    return built_in(turbines::wt600_description(), turbines::wt600_rated_speed(), [](int blade, int tower) {
        return turbines::AssemblyOptions{.tower_elements = tower, .blade_elements = blade};
    });
}

MachineFile teetered_machine() {
    const turbines::TurbineDescription description = turbines::teetered_description();
    return built_in(description, description.rotor_speed, [](int blade, int tower) {
        turbines::AssemblyOptions options = turbines::teetered_assembly();
        options.blade_beam->elements = blade;
        options.tower_beam->elements = tower;
        return options;
    });
}

MachineFile nrel5mw_as(turbines::Nrel5mwVariant variant) {
    constexpr double rated = 12.1;  // rpm, Table 1-1 of the report
    return built_in(turbines::nrel5mw_description(turbines::nrel5mw_options(variant)), rated * units::rpm,
                    [variant](int blade, int tower) { return turbines::nrel5mw_assembly(variant, blade, tower); });
}

MachineFile nrel5mw_spar() {
    const turbines::TurbineDescription description = turbines::nrel5mw_oc3_hywind_description();
    return built_in(description, description.rotor_speed, [](int blade, int tower) {
        return turbines::nrel5mw_assembly(turbines::Nrel5mwVariant::report, blade, tower);
    });
}

struct BuiltIn {
    const char *name, *about;
    MachineFile (*machine)();
};

using turbines::Nrel5mwVariant;
constexpr std::array machines{
    BuiltIn{"wt600", "600 kW, three blades", wt600_machine},
    BuiltIn{"teetered", "two blades on a teetered hub, downwind, free to yaw", teetered_machine},
    BuiltIn{"nrel5mw", "NREL 5 MW, three blades, as in its report", [] { return nrel5mw_as(Nrel5mwVariant::report); }},
    BuiltIn{"nrel5mw-fast", "likewise, as modelled in ElastoDyn", [] { return nrel5mw_as(Nrel5mwVariant::fast); }},
    BuiltIn{"nrel5mw-beamdyn", "likewise, with the blades of BeamDyn",
            [] { return nrel5mw_as(Nrel5mwVariant::beamdyn); }},
    BuiltIn{"nrel5mw-spar", "likewise, afloat on the OC3-Hywind spar; with --gravity", nrel5mw_spar}};

std::string names() {
    std::string all;
    for (const BuiltIn& one : machines) all += text(all.empty() ? "" : ", ", one.name);
    return all;
}

// A word that can only be meant as a name.
bool is_word(const std::filesystem::path& path) {
    std::error_code error;
    return !path.has_parent_path() && !path.has_extension() && !std::filesystem::exists(path, error);
}

MachineFile read_file(const std::filesystem::path& path) {
    MachineFile machine;
    if (!is_yaml(path)) {
        machine.kind = MachineKind::openfast;
        machine.file = turbines::read_openfast(path);
    } else if (turbines::is_description(text_file(path))) {
        machine.kind = MachineKind::description;
        machine.file.description = turbines::read_description(path);
        machine.file.rotor_speed = machine.file.description.rotor_speed;
        machine.file.yaw_drive = machine.file.description.yaw.rotation;
        machine.file.dofs.generator = machine.file.description.drive_train.spin == CoordinateRole::free;
        machine.file.dofs.tower_fore_aft = machine.file.dofs.tower_side_side = !machine.file.description.tower.rigid;
    } else {
        machine.kind = MachineKind::windio;
        machine.file = turbines::read_windio(path);
    }
    return machine;
}

// Directions in which the sections are rigid have no coordinate.
CardanBeamOptions beam_options(const BeamLine& line, int elements, bool extension) {
    CardanBeamOptions options;
    options.elements = elements;
    const Mat6 compliance = line.section(line.length / 2).compliance;
    options.torsion = compliance(3, 3) > 0;
    options.extension = extension && compliance(0, 0) > 0;
    return options;
}

// What was asked for in the place of what the machine's source says.
void set_dofs(const MachineOptions& a, turbines::TurbineFile& model) {
    turbines::Bearing& yaw = model.description.yaw.rotation;
    if (!a.generator.empty()) model.dofs.generator = a.generator == "free";
    model.description.drive_train.spin = model.dofs.generator ? CoordinateRole::free : CoordinateRole::driven;
    if (a.yaw == "locked") yaw = turbines::rigid_joint;
    if (a.yaw != "free" || !yaw.is_rigid()) return;
    if (model.yaw_drive.is_rigid())
        throw InputError("--yaw", "value", "free", "locked: the model gives no spring of a yaw drive");
    yaw = model.yaw_drive;
}

std::string dofs_in_words(const turbines::TurbineFile& model) {
    const turbines::FileDofs& f = model.dofs;
    std::string locked = f.generator ? "" : ", generator locked";
    if (model.description.yaw.rotation.is_rigid()) locked += ", yaw bearing locked";
    if (model.description.drive_train.main_shaft.is_rigid()) locked += ", main shaft rigid";
    if (!f.tower_fore_aft) locked += ", tower rigid fore-aft";
    if (!f.tower_side_side) locked += ", tower rigid side-side";
    if (!f.blades) locked += ", blades rigid";
    return locked.empty() ? "generator and yaw bearing free" : locked.substr(2);
}

void print(const std::vector<turbines::FileNote>& notes, bool all) {
    int groups = 0;
    for (const turbines::FileNote& note : notes) {
        const bool group = note.line == 0 && note.keyword != turbines::unusual_entries;
        if (group) ++groups;
        if (all || !group) std::cout << "note: " << to_text(note) << "\n";
    }
    if (!all && groups > 0) std::cout << groups << " more notes, on entries without meaning here: --notes\n";
}

// The beams of a machine that was read, with what its file holds rigid.
void set_beams(const MachineFile& machine, const MachineOptions& a, turbines::AssemblyOptions& o) {
    const turbines::TurbineDescription& d = machine.file.description;
    const turbines::FileDofs& dofs = machine.file.dofs;
    if (!d.tower.rigid) {
        o.tower_beam = beam_options(d.tower.line, a.tower_elements, false);
        o.tower_beam->held_y = !dofs.tower_side_side;
        o.tower_beam->held_z = !dofs.tower_fore_aft;
    }
    if (d.blades == 0) return;
    o.blade_beam = beam_options(d.blade.line, a.blade_elements, true);
    o.blade_beam->held_y = o.blade_beam->held_z = !dofs.blades;
}

}  // namespace

bool is_yaml(const std::filesystem::path& path) {
    const std::string ending = lower_case(path.extension().string());
    return ending == ".yaml" || ending == ".yml";
}

std::string machine_help() {
    std::string help =
        "A machine is a file (.fst or ElastoDyn file of OpenFAST, .yaml of windIO or our own), or one of:\n";
    for (const BuiltIn& one : machines)
        help += text("  ", one.name, std::string(18 - std::string(one.name).size(), ' '), one.about, "\n");
    return help;
}

MachineFile read_machine(const std::string& machine) {
    for (const BuiltIn& one : machines)
        if (machine == one.name) return one.machine();
    const std::filesystem::path path(machine);
    if (is_word(path)) throw InputError("machine", "name", machine, text(names(), ", or a file"));
    return read_file(path);
}

void add_machine(CommandLine& app, MachineOptions& options) {
    app.add_option("model", options.model, "name of a built-in machine, FILE.fst, ElastoDyn.dat or FILE.yaml")
        .required();
    app.footer(text("\n", machine_help()));
}

void add_machine_options(CommandLine& app, MachineOptions& options) {
    app.add_option("--blade-elements", options.blade_elements, "beam elements per blade");
    app.add_option("--tower-elements", options.tower_elements, "beam elements of the tower");
    app.add_option("--pitch", options.pitch, "pitch of the blades, deg, leading edge upwind (default: the model's)");
    const std::vector<std::string> free_or_locked{"free", "locked"};
    app.add_option("--generator", options.generator,
                   "free: the rotor turns freely; locked: at its speed, whatever happens (default: the model's, GenDOF "
                   "of ElastoDyn; else free)")
        .one_of(free_or_locked);
    app.add_option("--yaw", options.yaw,
                   "yaw bearing: free on the spring of the yaw drive, or locked (default: the model's, YawDOF of "
                   "ElastoDyn)")
        .one_of(free_or_locked);
    app.add_option("--generator-inertia", options.generator_inertia,
                   "inertia of the generator on its own shaft, kg m^2, for models that do not give it")
        .hide_default();
    app.add_flag("--undamped", options.undamped, "leave out all damping");
    app.add_flag("--notes", options.notes, "print all notes; else those on groups of entries are only counted");
    app.add_flag("--summary", options.summary, "print bodies, coordinates and masses first");
}

MachineFile prepared_machine(const MachineOptions& options) {
    MachineFile machine = read_machine(options.model);
    print(machine.file.notes, options.notes);
    set_dofs(options, machine.file);
    std::cout << "degrees of freedom: " << dofs_in_words(machine.file) << "\n";
    if (options.generator_inertia != 0)
        machine.file.description.drive_train.generator_inertia = options.generator_inertia;
    return machine;
}

turbines::AssemblyOptions assembly_options(const MachineFile& machine, const MachineOptions& options) {
    turbines::AssemblyOptions o;
    if (machine.beams)
        o = machine.beams(options.blade_elements, options.tower_elements);
    else
        set_beams(machine, options, o);
    o.spin = CoordinateRole::free;  // how it turns (FileDofs::generator) is left to the analysis
    o.pitch = options.pitch ? *options.pitch * units::degree : machine.file.pitch;
    if (options.gravity) o.gravity = {0, 0, -units::standard_gravity};
    if (options.undamped) o.structural_damping = o.joint_damping = false;
    return o;
}

bool has_equal_blades(const turbines::TurbineDescription& machine) {
    return machine.blades > 2 && machine.own_blades.empty();
}

}  // namespace cardan::program
