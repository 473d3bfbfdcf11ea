#include "programs/shared/machine_file.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/machine/built_in.hpp"
#include "turbines/yaml/foundation.hpp"

#include "programs/shared/program.hpp"
#include "programs/shared/run_record.hpp"
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

namespace cardan::program {

namespace {

// "a.b=1" as YAML.
turbines::ModelAddition addition_of(const std::string& assignment) {
    const std::size_t equal = assignment.find('=');
    if (equal == 0 || equal == std::string::npos)
        throw InputError("--set", "value", assignment, "KEY=VALUE, as in components.hub.elastic_properties.mass=1e5");
    std::string begin, end;
    for (std::size_t at = 0; at < equal;) {
        const std::size_t dot = std::min(assignment.find('.', at), equal);
        begin += (begin.empty() ? "" : ": {") + assignment.substr(at, dot - at);
        end += begin.find('{') == std::string::npos ? "" : "}";
        at = dot + 1;
    }
    return {text(begin, ": ", assignment.substr(equal + 1), end, "\n"), text("--set ", assignment)};
}

// What --with and --set add to a model of windIO.
std::vector<turbines::ModelAddition> additions_of(const MachineOptions& options) {
    std::vector<turbines::ModelAddition> additions;
    for (const std::string& file : options.with) additions.push_back({text_file(file), file});
    for (const std::string& assignment : options.set) additions.push_back(addition_of(assignment));
    return additions;
}

// What was asked for in the place of what the machine's source says.
void set_dofs(const MachineOptions& a, turbines::Machine& model) {
    turbines::Bearing& yaw = model.description.yaw.rotation;
    turbines::FileDofs f = dofs_of(model.description);
    if (!a.generator.empty()) f.generator = a.generator == "free";
    if (!a.blades.empty()) f.blades = a.blades == "bend";
    if (!a.tower.empty()) {
        f.tower_fore_aft = a.tower == "bends" || a.tower == "fore-aft";
        f.tower_side_side = a.tower == "bends" || a.tower == "side-side";
    }
    set_dofs(f, model.description);
    if (a.yaw == "locked") yaw = turbines::rigid_joint;
    if (a.yaw == "driven") yaw = turbines::driven_joint;
    if (a.yaw != "free" || !yaw.is_rigid()) return;
    if (model.yaw_drive.is_rigid())
        throw InputError("--yaw", "value", "free", "locked: the model gives no spring of a yaw drive");
    yaw = model.yaw_drive;
}

void tell_dofs(const turbines::Machine& model, MachineOptions& a) {
    const turbines::FileDofs f = dofs_of(model.description);
    a.generator = f.generator ? "free" : "locked";
    const turbines::Bearing& yaw = model.description.yaw.rotation;
    a.yaw = yaw.is_rigid() ? "locked" : yaw.hold == turbines::Bearing::Hold::driven ? "driven" : "free";
    a.blades = f.blades ? "bend" : "rigid";
    a.tower =
        f.tower_fore_aft ? (f.tower_side_side ? "bends" : "fore-aft") : (f.tower_side_side ? "side-side" : "rigid");
}

// A diagram of a machine that a file holds altogether would be empty: its beams bend.
void free_beams_if_nothing_moves(turbines::Machine& model) {
    const turbines::TurbineDescription& d = model.description;
    const bool teeters = d.hub.teeter && !d.hub.teeter->bearing.is_rigid();
    turbines::FileDofs f = dofs_of(model.description);
    if (f.generator || f.blades || !d.tower.rigid || teeters || !d.yaw.rotation.is_rigid() ||
        !d.drive_train.main_shaft.is_rigid())
        return;
    f.blades = f.tower_fore_aft = f.tower_side_side = true;
    set_dofs(f, model.description);
    std::cout << "note: the model switches off all degrees of freedom: tower and blades bend here\n";
}

std::string dofs_in_words(const turbines::Machine& model) {
    const turbines::FileDofs f = dofs_of(model.description);
    std::string locked = f.generator ? "" : ", generator locked";
    const turbines::Bearing& yaw = model.description.yaw.rotation;
    if (yaw.is_rigid()) locked += ", yaw bearing locked";
    if (yaw.hold == turbines::Bearing::Hold::driven) locked += ", yaw prescribed";
    if (model.description.drive_train.main_shaft.is_rigid()) locked += ", main shaft rigid";
    if (!f.tower_fore_aft) locked += ", tower rigid fore-aft";
    if (!f.tower_side_side) locked += ", tower rigid side-side";
    if (!f.blades) locked += ", blades rigid";
    return locked.empty() ? "generator and yaw bearing free" : locked.substr(2);
}

}  // namespace

void print_notes(const std::vector<turbines::FileNote>& notes, bool all) {
    int groups = 0;
    for (const turbines::FileNote& note : notes) {
        const bool group = note.line == 0 && note.keyword != turbines::unusual_entries;
        if (group) ++groups;
        if (all || !group) std::cout << "note: " << to_text(note) << "\n";
    }
    if (!all && groups > 0) std::cout << groups << " more notes, on entries without meaning here: --notes\n";
}

std::string machine_help() {
    std::string help =
        "A machine is a file (.fst or ElastoDyn file of OpenFAST, .yaml of windIO or our own, .h5 of a result), or one "
        "of:\n";
    for (const turbines::BuiltInMachine& one : turbines::built_in_machines())
        help += text("  ", one.name, std::string(18 - one.name.size(), ' '), one.about, "\n");
    return help;
}

void add_machine(CommandLine& app, MachineOptions& options) {
    app.add_option("model", options.model,
                   "name of a built-in machine, FILE.fst, ElastoDyn.dat, FILE.yaml or RESULT.h5")
        .required();
    app.footer(text("\n", machine_help()));
}

void add_source_options(CommandLine& app, MachineOptions& options) {
    app.add_option(
           "--with", options.with,
           "windIO: a file with entries that the model lacks, or others in the place of its own, under the same "
           "keys; may be given several times")
        .one_word()
        .type_name("FILE");
    app.add_option("--set", options.set, "windIO: the same for a single entry").one_word().type_name("KEY=VALUE");
    const std::vector<std::string> free_or_locked{"free", "locked"};
    app.add_option("--generator", options.generator,
                   "free: the rotor turns freely; locked: at its speed, whatever happens (default: the model's, GenDOF "
                   "of ElastoDyn; else free)")
        .one_of(free_or_locked);
    app.add_option("--yaw", options.yaw,
                   "yaw bearing: free on the spring of the yaw drive, locked, or driven, as a controller in a library "
                   "turns it (default: the model's, YawDOF of ElastoDyn)")
        .one_of({"free", "locked", "driven"});
    app.add_option("--tower", options.tower,
                   "tower: it bends, only in one direction, or is rigid (default: the model's, TwFADOF and TwSSDOF of "
                   "ElastoDyn)")
        .one_of({"bends", "fore-aft", "side-side", "rigid"});
    app.add_option("--blades", options.blades,
                   "blades: they bend, or are rigid (default: the model's, FlapDOF and EdgeDOF of ElastoDyn)")
        .one_of({"bend", "rigid"});
    app.add_option(
           "--foundation", options.foundation,
           "file (.yaml) with what the tower stands on: stiffness, mass and damping, 6 x 6 matrices at its foot "
           "(default: it is clamped there)")
        .type_name("FILE");
    app.add_option("--generator-inertia", options.generator_inertia,
                   "inertia of the generator on its own shaft, kg m^2, for models that do not give it")
        .hide_default();
    app.add_flag("--notes", options.notes, "print all notes; else those on groups of entries are only counted");
}

void add_machine_options(CommandLine& app, MachineOptions& options) {
    add_source_options(app, options);
    app.add_option("--pitch", options.pitch, "pitch of the blades, deg, leading edge upwind (default: the model's)");
    app.add_option("--blade-elements", options.blade_elements, "beam elements per blade (default: as many as it takes)")
        .range(1, 1000)
        .hide_default();
    app.add_option("--tower-elements", options.tower_elements,
                   "beam elements of the tower (default: as many as it takes)")
        .range(1, 1000)
        .hide_default();
    app.add_flag("--undamped", options.undamped, "leave out all damping");
    app.add_flag("--summary", options.summary, "print bodies, coordinates and masses first");
}

namespace {

void set_foundation(const std::string& file, turbines::Machine& model) {
    if (file.empty()) return;
    if (model.description.platform)
        throw InputError("--foundation", "file", file,
                         text("none: the tower stands on ", model.description.platform->name));
    model.description.platform = turbines::read_foundation(file);
}

// What the model's tower stands on, where it is left out.
bool is_clamped(const turbines::Machine& machine) {
    const turbines::TurbineDescription& d = machine.description;
    return !d.missing_foundation.name.empty() && !d.platform;
}

}  // namespace

std::string foundation_in_words(const turbines::Machine& machine) {
    const std::string& name = machine.description.missing_foundation.name;
    return is_clamped(machine) ? text("tower clamped at its foot, ", name, " left out") : "";
}

turbines::Machine prepared_machine(MachineOptions& options) {
    turbines::Machine machine = turbines::read_machine(options.model, additions_of(options));
    print_notes(machine.notes, options.notes);
    set_dofs(options, machine);
    set_foundation(options.foundation, machine);
    free_beams_if_nothing_moves(machine);
    tell_dofs(machine, options);
    std::cout << "degrees of freedom: " << dofs_in_words(machine) << "\n";
    if (is_clamped(machine)) {
        const auto& [name, where] = machine.description.missing_foundation;
        std::cout << "foundation: the " << name << " of the model is left out, and the tower clamped at its foot, "
                  << where << "; --foundation FILE gives it springs\n";
    }
    if (options.generator_inertia != 0) machine.description.drive_train.generator_inertia = options.generator_inertia;
    return machine;
}

turbines::AssemblyOptions assembly_options(const turbines::Machine& machine, const MachineOptions& options) {
    turbines::AssemblyOptions o;
    if (options.blade_elements > 0) o.blade_elements = options.blade_elements;
    if (options.tower_elements > 0) o.tower_elements = options.tower_elements;
    o.spin = CoordinateRole::free;  // how it turns (FileDofs::generator) is left to the analysis
    o.pitch = options.pitch ? *options.pitch * units::degree : machine.operation.pitch;
    if (options.gravity) o.gravity = {0, 0, -units::standard_gravity};
    if (options.undamped) o.structural_damping = o.joint_damping = false;
    return o;
}

int first_blade(const turbines::TurbineDescription& description) {
    int first = 1;
    while (first <= description.blades && description.blade_at(first) == nullptr) ++first;
    return first;
}

double usual_frequency(const turbines::Machine& machine, const MachineOptions& options) {
    return turbines::usual_frequency(machine.description, assembly_options(machine, options));
}

ReadyMachine ready_machine(const turbines::Machine& machine, MachineOptions& options, double largest_hz,
                           double rotor_speed) {
    const turbines::TurbineDescription& description = machine.description;
    turbines::AssemblyOptions assembly = assembly_options(machine, options);
    assembly.mesh.largest_hz = largest_hz;
    assembly.mesh.rotor_speed = rotor_speed;
    const turbines::Turbine turbine = turbines::assemble(description, assembly);
    // Numbers that were asked for are judged as well.
    const turbines::Mesh mesh =
        turbine.mesh().largest_hz > 0 ? turbine.mesh() : turbines::converged_mesh(description, assembly);
    options.blade_elements = mesh.blade_elements;
    options.tower_elements = mesh.tower_elements;
    if (description.platform) std::cout << "mesh: chosen with the " << description.platform->name << " held\n";
    introduce(turbine, options.summary);
    return {turbine, mesh};
}

std::string run_text(const std::string& command, const CommandLine& options) {
    return to_text({command, {}, options.words()});
}

}  // namespace cardan::program
