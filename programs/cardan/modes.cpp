// Modes of any machine at one rotor speed: a Campbell diagram of one point, with all that is known of each mode.
//
// Problem and theory are those of `cardan campbell`; at rest the modes of all degrees of freedom, a rotor that is free
// to turn included. Of a machine whose source lacks masses those of blade and tower by themselves.
#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "programs/cardan/commands.hpp"
#include "programs/cardan/options.hpp"
#include "programs/shared/campbell_program.hpp"
#include "turbines/analysis/campbell.hpp"
#include "turbines/analysis/part_modes.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <ranges>

namespace cardan::program {

namespace {

struct ModesArguments {
    MachineOptions machine;
    double rpm = 0;
    std::optional<double> max_frequency;
    std::string like, out;
    bool shapes = false;
};

void declare(CommandLine& app, ModesArguments& a) {
    add_machine(app, a.machine);
    app.add_option("--rpm", a.rpm, "rotor speed, rev/min").not_negative();
    add_machine_options(app, a.machine);
    app.add_option("--max-frequency", a.max_frequency,
                   "modes up to this frequency, Hz (default: 1.3 times the third of the blade, clamped and at rest)")
        .positive();
    add_like(app, a.like);
    app.add_flag("--gravity", a.machine.gravity, "with gravity");
    app.add_flag("--shapes", a.shapes, "draw the shapes: PREFIX/<mode>_<rpm>rpm.svg, .png");
    app.add_option("--out", a.out, "prefix of the files (default: the machine's name and _modes)");
}

// The three largest parts of the elastic energy: "blade flap 1 81 %, tower fore-aft 1 12 %".
std::string energy_in_words(const solvers::Campbell& diagram, const solvers::CampbellMode& mode) {
    std::vector<const solvers::EnergyFraction*> shares;
    shares.reserve(mode.shares.size());
    for (const solvers::EnergyFraction& share : mode.shares) shares.push_back(&share);
    std::ranges::sort(shares, std::ranges::greater(), [](const solvers::EnergyFraction* s) { return s->total(); });
    if (shares.size() > 3) shares.resize(3);
    std::string words;
    for (const solvers::EnergyFraction* share : shares) {
        if (share->total() < 0.01) break;
        const solvers::Component& c = entry(diagram.components, share->component);
        words +=
            text(words.empty() ? "" : ", ", c.ordinal, ". ", c.family, " ", std::lround(100 * share->total()), " %");
    }
    return words;
}

void print(const solvers::Campbell& diagram) {
    std::printf("%s: modes at %g rpm; %s\n", diagram.machine.c_str(),
                diagram.points.front().rotor_speed * units::to_rpm, method_in_words(diagram).c_str());
    if (!diagram.remark.empty()) std::printf("%s\n", diagram.remark.c_str());
    std::printf("\n%-36s %14s %11s %9s   %s\n", "mode", "|lambda|/2pi Hz", "damped Hz", "damping %", "elastic energy");
    for (const solvers::Branch& branch : diagram.branches) {
        const solvers::CampbellMode* mode = diagram.mode(branch, 0);
        if (mode == nullptr) continue;
        const std::string& doubt = branch.doubt[0];
        std::printf("%-36s %14.4f %12.4f %9.3f   %s%s\n", (branch.name + (branch.doubtful[0] ? " ?" : "")).c_str(),
                    diagram.natural_hz(branch, 0), diagram.damped_hz(branch, 0), 100 * diagram.damping_ratio(branch, 0),
                    energy_in_words(diagram, *mode).c_str(), doubt.empty() ? "" : text("  ? ", doubt).c_str());
    }
    std::printf("%s\n", diagram.accuracy.c_str());
    if (!diagram.warning.empty()) std::printf("\nwarning: %s\n", diagram.warning.c_str());
}

// Of a machine whose source lacks masses: nothing is known of the whole, so that no files are written.
int print_parts(const turbines::Machine& machine, const ModesArguments& a) {
    turbines::PartModesSettings settings{.machine = numbers_of(a.machine), .max_frequency_hz = a.max_frequency};
    if (a.rpm != 0) settings.rotor_speeds = {0, a.rpm * units::rpm};
    const turbines::PartModes parts = turbines::part_modes(machine, settings);
    stop_at_once();
    if (!parts.blade && !parts.tower) machine.description.require_complete();
    for (const auto& part : {parts.blade, parts.tower})
        if (part) {
            print_table(*part);
            std::printf("\n");
        }
    std::printf("modes of the parts only: %s\n", in_words(machine.description.missing).c_str());
    return 0;
}

int run(ModesArguments& a, const CommandLine& command) {
    if (a.out.empty()) a.out = default_prefix(a.machine.model, "modes");
    check_outputs(a.out, {".h5", ".csv"}, {a.machine.model});
    const turbines::Machine machine = prepared_machine(a.machine);
    if (!machine.description.missing.empty()) return print_parts(machine, a);
    stop_at_once();  // nothing is kept
    turbines::CampbellDiagram diagram = turbines::campbell(machine, {.rotor_speeds = {a.rpm * units::rpm},
                                                                     .machine = numbers_of(a.machine),
                                                                     .gravity = a.machine.gravity,
                                                                     .max_frequency_hz = a.max_frequency,
                                                                     .like = a.like,
                                                                     .report = remarks_printed(a.machine.notes)});
    if (a.machine.summary) std::cout << diagram.turbine->summary() << "\n";
    keep_taken(diagram.settings.machine, a.machine);
    a.max_frequency = diagram.settings.max_frequency_hz;
    a.like = diagram.settings.like.string();
    diagram.source = run_text("modes", command) + diagram.source;
    print(diagram);
    solvers::write_hdf5(diagram, a.out + ".h5");
    solvers::write_csv(diagram, a.out + ".csv");
    if (a.shapes) draw_modes(diagram, a.out);
    std::printf("\nfiles: %s.h5, .csv%s\n", a.out.c_str(), a.shapes ? text("; shapes in ", a.out, "/").c_str() : "");
    return 0;
}

}  // namespace

int modes_command(int argc, char** argv) {
    return run_command<ModesArguments>("cardan modes",
                                       "Modes of any machine at one rotor speed, with their elastic energy by parts.\n"
                                       "Writes PREFIX.h5 and PREFIX.csv, and prints a table.",
                                       argc, argv, declare, run);
}

}  // namespace cardan::program
