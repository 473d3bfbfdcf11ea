#include "programs/shared/machine_file.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/program.hpp"
#include "programs/shared/remarks.hpp"
#include "programs/shared/run_record.hpp"
#include "turbines/analysis/in_unit.hpp"
#include "turbines/machine/built_in.hpp"
#include "turbines/yaml/foundation.hpp"

#include <algorithm>
#include <array>
#include <iostream>
#include <iterator>
#include <set>
#include <utility>

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

void tell_dofs(const turbines::Machine& model, MachineOptions& a) {
    const turbines::FileDofs f = dofs_of(model.description);
    a.generator = f.generator ? "free" : "locked";
    const turbines::JointSupport& yaw = model.description.yaw.rotation;
    a.yaw = yaw.is_rigid() ? "locked" : yaw.kind == turbines::JointSupport::Kind::prescribed ? "driven" : "free";
    a.blades = f.blades ? "bend" : "rigid";
    a.tower =
        f.tower_fore_aft ? (f.tower_side_side ? "bends" : "fore-aft") : (f.tower_side_side ? "side-side" : "rigid");
}

// A note that several files have alike.
struct SharedNote {
    turbines::FileNote note;         // of the first one
    std::vector<std::string> files;  // the others
};

std::vector<SharedNote> shared(const std::vector<turbines::FileNote>& notes) {
    std::vector<SharedNote> all;
    for (const turbines::FileNote& note : notes) {
        const auto alike = std::ranges::find_if(all, [&](const SharedNote& other) {
            return other.note.file != note.file && other.note.keyword == note.keyword &&
                   other.note.value == note.value && other.note.why == note.why;
        });
        if (alike == all.end())
            all.push_back({note, {}});
        else
            alike->files.push_back(std::filesystem::path(note.file).filename().string());
    }
    return all;
}

std::string in_words(const SharedNote& one) {
    std::string others;
    for (const std::string& file : one.files) others += text(others.empty() ? " (likewise " : ", ", file);
    return text(to_text(one.note), others, others.empty() ? "" : ")");
}

// "notes: 83 entries of 5 files are not used, 4 are used otherwise; --notes lists them"
std::string counted(const std::vector<SharedNote>& notes, const char* what_they_are) {
    using Kind = turbines::FileNote::Kind;
    constexpr std::array words{std::pair(Kind::unused, "not used"), std::pair(Kind::otherwise, "used otherwise"),
                               std::pair(Kind::left_out, "left out")};
    std::set<std::string> files;
    for (const SharedNote& one : notes) files.insert(one.note.file);
    std::string line;
    for (const auto& [kind, what] : words) {
        std::size_t entries = 0;
        for (const SharedNote& one : notes)
            if (one.note.kind == kind) entries += one.note.entries();
        if (entries == 0) continue;
        line += text(line.empty() ? text(what_they_are, ": ") : ", ", entries);
        if (line.find(" of ") == std::string::npos)
            line += text(entries == 1 ? " entry of " : " entries of ", files.size(),
                         files.size() == 1 ? " file" : " files");
        line += text(entries == 1 ? " is " : " are ", what);
        if (kind == Kind::left_out) line += text(", though the model asks for ", entries == 1 ? "it" : "them");
    }
    return line + "; --notes lists them\n";
}

std::string dofs_in_words(const turbines::Machine& model) {
    const turbines::FileDofs f = dofs_of(model.description);
    std::string locked = f.generator ? "" : ", generator locked";
    const turbines::JointSupport& yaw = model.description.yaw.rotation;
    if (yaw.is_rigid()) locked += ", yaw bearing locked";
    if (yaw.kind == turbines::JointSupport::Kind::prescribed) locked += ", yaw prescribed";
    if (model.description.drive_train.main_shaft.is_rigid()) locked += ", main shaft rigid";
    if (!f.tower_fore_aft) locked += ", tower rigid fore-aft";
    if (!f.tower_side_side) locked += ", tower rigid side-side";
    if (!f.blades) locked += ", blades rigid";
    return locked.empty() ? "generator and yaw bearing free" : locked.substr(2);
}

}  // namespace

void print_notes(const std::vector<turbines::FileNote>& notes, bool all, const char* what) {
    const std::vector<SharedNote> once = shared(notes);
    for (const SharedNote& one : once)
        if (all || one.note.keyword == turbines::unusual_entries) std::cout << "note: " << in_words(one) << "\n";
    if (!all && !once.empty()) std::cout << counted(once, what);
}

void print_notes(const std::vector<turbines::FileNote>& notes, MachineOptions& options, const char* what) {
    print_notes(notes, options.notes, what);
    std::ranges::copy_if(notes, std::back_inserter(options.left_out), [](const turbines::FileNote& note) {
        return note.kind == turbines::FileNote::Kind::left_out;
    });
}

void print_left_out(const MachineOptions& options) {
    constexpr std::size_t max = 8;
    std::vector<std::string> names;
    for (const turbines::FileNote& note : options.left_out)
        if (std::ranges::find(names, note.keyword) == names.end()) names.push_back(note.keyword);
    if (names.empty()) return;
    std::cout << "left out, though the model asks for it: ";
    for (std::size_t i = 0; i < std::min(max, names.size()); ++i) std::cout << (i > 0 ? ", " : "") << names[i];
    if (names.size() > max) std::cout << " and " << names.size() - max << " more entries";
    std::cout << (options.notes ? "; see the notes\n" : "; --notes says why\n");
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
        .not_negative()
        .hide_default();
    app.add_option("--blade-damping", options.blade_damping,
                   "damping of the first flap mode of a blade, clamped and at rest, % of critical, growing with the "
                   "frequency, in the place of all structural damping that the blades have (default: the model's)")
        .not_negative();
    app.add_option("--tower-damping", options.tower_damping,
                   "likewise of the first bending mode of the tower, % (default: the model's)")
        .not_negative();
    app.add_option("--pitch-stiffness", options.pitch_stiffness,
                   "spring in the pitch bearing of every blade, N m/rad (default: the model's)")
        .positive();
    app.add_option("--pitch-damping", options.pitch_damping,
                   "damper beside this spring, N m s/rad (default: the model's)")
        .not_negative();
    app.add_flag("--notes", options.notes,
                 "print what entries of the model's files are not used, or used otherwise; else they are counted");
}

void add_machine_options(CommandLine& app, MachineOptions& options) {
    add_source_options(app, options);
    app.add_option("--pitch", options.pitch, "pitch of the blades, deg, leading edge upwind (default: the model's)")
        .finite();
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

turbines::MachineSettings numbers_of(const MachineOptions& options) {
    turbines::MachineSettings settings;
    if (options.pitch) settings.pitch = *options.pitch * units::degree;
    if (options.blade_elements > 0) settings.blade_elements = options.blade_elements;
    if (options.tower_elements > 0) settings.tower_elements = options.tower_elements;
    settings.damping = !options.undamped;
    return settings;
}

void keep_taken(const turbines::MachineSettings& taken, MachineOptions& options) {
    if (taken.pitch) options.pitch = turbines::in_unit(*taken.pitch, units::degree);
    options.blade_elements = *taken.blade_elements;
    options.tower_elements = *taken.tower_elements;
}

namespace {

// All that the options say of the machine.
turbines::MachineSettings settings_of(const MachineOptions& a) {
    using namespace turbines;
    constexpr std::array towers{std::pair("bends", TowerDof::bends), std::pair("fore-aft", TowerDof::fore_aft),
                                std::pair("side-side", TowerDof::side_side), std::pair("rigid", TowerDof::rigid)};
    constexpr std::array yaws{std::pair("free", YawDof::free), std::pair("locked", YawDof::locked),
                              std::pair("driven", YawDof::prescribed)};
    MachineSettings settings = numbers_of(a);
    if (!a.generator.empty()) settings.generator = a.generator == "free" ? GeneratorDof::free : GeneratorDof::locked;
    for (const auto& [name, value] : yaws)
        if (a.yaw == name) settings.yaw = value;
    for (const auto& [name, value] : towers)
        if (a.tower == name) settings.tower = value;
    if (!a.blades.empty()) settings.blades = a.blades == "bend" ? BladeDof::bend : BladeDof::rigid;
    if (!a.foundation.empty()) settings.foundation = read_foundation(a.foundation);
    if (a.generator_inertia != 0) settings.generator_inertia = a.generator_inertia;
    if (a.blade_damping) settings.blade_damping = *a.blade_damping / 100;
    if (a.tower_damping) settings.tower_damping = *a.tower_damping / 100;
    settings.pitch_stiffness = a.pitch_stiffness;
    settings.pitch_damping = a.pitch_damping;
    return settings;
}

}  // namespace

turbines::Report remarks_printed(bool all_notes) {
    return [all_notes](const turbines::Remark& remark) {
        if (remark.kind == turbines::Remark::Kind::file) return print_notes(remark.entries, all_notes);
        print_remark(remark);
    };
}

turbines::Machine prepared_machine(MachineOptions& options) {
    turbines::Machine machine = turbines::read_machine(options.model, additions_of(options));
    print_notes(machine.notes, options);
    machine = turbines::with_settings(std::move(machine), settings_of(options), remarks_printed(options.notes));
    tell_dofs(machine, options);
    std::cout << "degrees of freedom: " << dofs_in_words(machine) << "\n";
    if (turbines::is_clamped(machine)) {
        const auto& [name, where] = machine.description.missing_foundation;
        std::cout << "foundation: the " << name << " of the model is left out, and the tower clamped at its foot, "
                  << where << "; --foundation FILE gives it springs\n";
    }
    return machine;
}

turbines::AssemblyOptions assembly_options(const turbines::Machine& machine, const MachineOptions& options) {
    return turbines::assembly_options(machine, numbers_of(options), options.gravity);
}

double usual_frequency(const turbines::Machine& machine, const MachineOptions& options) {
    return turbines::usual_frequency(machine.description, assembly_options(machine, options));
}

turbines::PreparedTurbine ready_machine(const turbines::Machine& machine, MachineOptions& options, double max_hz,
                                        double rotor_speed) {
    turbines::PreparedTurbine ready = turbines::assembled(machine, assembly_options(machine, options), max_hz,
                                                          rotor_speed, remarks_printed(options.notes));
    options.blade_elements = ready.mesh.blade_elements;
    options.tower_elements = ready.mesh.tower_elements;
    if (options.summary) std::cout << ready.turbine.summary() << "\n";
    return ready;
}

std::string run_text(const std::string& command, const CommandLine& options) {
    return to_text({command, {}, options.words()});
}

}  // namespace cardan::program
