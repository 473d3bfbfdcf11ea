// Campbell diagram of any machine: one that exists as an OpenFAST or windIO model, our own file, a built-in one.
//
// Problem: the files of the model (OpenFAST's .fst or ElastoDyn file, a windIO .yaml, or our own .yaml) become a
// description of the machine, blades and tower as beams; at every rotor speed it is brought to its steady state and
// linearised, and the multi-blade transformation makes the equations constant. With gravity or an unbalanced hub the
// steady state is periodic and the modes are those of the mean over the azimuth, with two blades they are Floquet's.
// What the files hold beside the structure, and what is taken otherwise than in the program they were made for, is
// printed as notes. Frames, signs, and what is read: docs/coming_from_openfast.md.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/model/beam_table.hpp"
#include "turbines/yaml/description.hpp"

#include "examples/programs/campbell_program.hpp"
#include "examples/shared/machine_file.hpp"
#include <algorithm>
#include <iostream>
#include <optional>

using namespace cardan;

namespace {

struct Arguments {
    program::MachineOptions machine;
    std::string rpm, out = "openfast_campbell", save;
    std::optional<double> max_frequency;
};

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "Campbell diagram of any machine: OpenFAST (.fst, or an ElastoDyn file), windIO (.yaml), our own .yaml, or a "
        "built-in one.\n"
        "Writes PREFIX.h5, PREFIX.csv, PREFIX.svg, PREFIX.png, and prints a table.");
    program::add_machine(app, a.machine);
    app.add_option("--rpm", a.rpm,
                   "rotor speeds, numbers and FIRST:LAST:STEP separated by commas, rev/min (default: from 0 to 1.2 "
                   "times the model's, in 12 steps)");
    program::add_machine_options(app, a.machine);
    app.add_option(
        "--max-frequency", a.max_frequency,
        "follow modes up to this frequency, Hz (default: 1.3 times the third of the blade, clamped and at rest)");
    app.add_flag("--gravity", a.machine.gravity, "with gravity");
    app.add_option("--out", a.out, "prefix of the files");
    app.add_option("--save", a.save, "also write the machine as our own YAML to this file (.yaml)");
    return app.parse(argc, argv);
}

std::vector<double> rotor_speeds(const std::string& given, const turbines::TurbineFile& model) {
    if (!given.empty()) return program::rotor_speeds(given);
    const double rated = model.rotor_speed * units::to_rpm;
    if (!(rated > 0))
        throw InputError("--rpm", "value", "none, and the model names no rotor speed", program::rpm_format);
    std::cout << "rotor speeds: 0 to " << 1.2 * rated << " rpm, 1.2 times " << rated << " rpm";
    if (!model.rotor_speed_source.empty()) std::cout << " (" << model.rotor_speed_source << ")";
    std::cout << "\n";
    return solvers::rpm_range(0, 1.2 * rated, 0.1 * rated);
}

// The mean over the azimuth is an approximation that serves equal blades under gravity or on an unbalanced hub.
solvers::CampbellMethod method_for(const Arguments& a, const turbines::TurbineDescription& machine) {
    const RigidInertia& hub = machine.hub.inertia;
    const bool balanced = hub.com.head<2>().isZero(0) && hub.J(0, 0) == hub.J(1, 1) && hub.J(0, 1) == 0 &&
                          hub.J(0, 2) == 0 && hub.J(1, 2) == 0;
    return program::has_equal_blades(machine) && (a.machine.gravity || !balanced) ? solvers::CampbellMethod::averaged
                                                                                  : solvers::CampbellMethod::automatic;
}

void save(const Arguments& a, const program::MachineFile& machine) {
    const turbines::TurbineFile& model = machine.file;
    std::error_code error;
    if (!program::is_yaml(a.save)) throw InputError("--save", "file", a.save, "one that ends in .yaml");
    if (std::filesystem::equivalent(a.save, a.machine.model, error))
        throw InputError("--save", "file", a.save, "another one than the model");
    turbines::TurbineDescription description = model.description;
    for (BeamLine* line : {&description.tower.line, &description.blade.line})
        if (machine.kind == program::MachineKind::built_in && turbines::table_of(*line) == nullptr)
            *line = turbines::beam_line(turbines::sampled(*line));
    turbines::write_description(description, a.save);
    const turbines::FileDofs& f = model.dofs;
    if (model.pitch != 0)
        std::cout << "note: " << a.save << " holds the machine, not how it runs: --pitch "
                  << model.pitch * units::to_degrees << "\n";
    const bool partly_rigid = f.tower_fore_aft != f.tower_side_side;
    if (partly_rigid || !f.blades)
        std::cout << "note: " << a.save << " holds "
                  << (partly_rigid && !f.blades ? "tower and blades"
                      : f.blades                ? "the tower"
                                                : "the blades")
                  << " with the stiffness of the model, not what is rigid here\n";
}

int run(const Arguments& given) {
    Arguments a = given;
    const program::MachineFile machine = program::prepared_machine(a.machine);
    const turbines::TurbineFile& model = machine.file;
    if (!a.save.empty()) save(a, machine);
    const std::vector<double> speeds = rotor_speeds(a.rpm, model);
    const double highest = std::abs(
        *std::max_element(speeds.begin(), speeds.end(), [](double x, double y) { return std::abs(x) < std::abs(y); }));
    const double max_frequency = a.max_frequency ? *a.max_frequency : program::usual_frequency(machine, a.machine);
    const turbines::Mesh mesh = program::choose_mesh(machine, a.machine, max_frequency, highest);
    const turbines::Turbine turbine =
        turbines::assemble(model.description, program::assembly_options(machine, a.machine));
    program::introduce(turbine, a.machine.summary);

    program::check_outputs(a.out, {".h5", ".csv", ".svg", ".png"});
    solvers::CampbellOptions options = program::campbell_options(max_frequency);
    options.method = method_for(a, model.description);
    options.spin = model.dofs.generator ? solvers::RotorSpin::free : solvers::RotorSpin::prescribed;
    const solvers::Campbell diagram = solvers::campbell(turbine.system(), turbine.rotor(), speeds, options);
    program::stop_at_once();
    program::print_table(diagram);
    std::cout << program::in_words(mesh) << "\n";
    if (diagram.points.empty()) return 130;
    solvers::CampbellPlotOptions picture;
    picture.max_frequency_hz = max_frequency;
    program::write_files(diagram, a.out, picture);
    std::cout << "\nfiles: " << a.out << ".h5, .csv, .svg, .png" << (a.save.empty() ? "" : ", " + a.save) << "\n";
    return diagram.complete ? 0 : 130;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("openfast_campbell", argc, argv, parse, run);
}
