// Campbell diagram of the two-bladed teetered machine.
//
// Problem: the machine of Lee, Hodges and Patil, Wind Energy 5 (2002), Table I, free to yaw and to teeter. Two blades
// make its equations periodic, whatever the coordinates: at every rotor speed the periodic steady state is found by
// harmonic balance, the equations are linearised about it, and Floquet's theory gives the motions, with frequencies
// that prevail (tower modes in the fixed frame, blade modes in the rotating frame), damping and stability. Reference:
// frequencies at 6.02 rad/s (57.5 rev/min) in docs/verification.md.
#include "mbs/error.hpp"
#include "solvers/campbell_csv.hpp"
#include "solvers/hdf5_campbell.hpp"
#include "turbines/teetered.hpp"

#include "examples/campbell_program.hpp"
#include <filesystem>
#include <iostream>
#include <optional>

using namespace cardan;

namespace {

struct Arguments {
    std::string rpm = "10:80:2.5", out = "teetered_campbell", data;
    int tower_elements = 3, blade_elements = 3, harmonics = 8;
    double tower_ratio = 100, max_frequency = 12;
    std::optional<double> max_per_rev;
    bool rigid_tower = false, no_teeter = false, gravity = false, modes = false, summary = false;
};

int parse(int argc, char** argv, Arguments& a) {
    CLI::App app(
        "Campbell diagram of the two-bladed teetered machine (Lee, Hodges, Patil 2002) by Floquet's theory.\n"
        "Writes PREFIX.h5, PREFIX.csv, PREFIX.svg and PREFIX.png, and prints a table.");
    app.add_option("--rpm", a.rpm, "rotor speeds FIRST:LAST:STEP (or one), rev/min; nominal 57.5")
        ->capture_default_str();
    auto* ratio = app.add_option("--tower-ratio", a.tower_ratio, "rigidity of the tower over that of the blades")
                      ->capture_default_str();
    app.add_flag("--rigid-tower", a.rigid_tower, "no elastic tower")->excludes(ratio);
    app.add_option("--blade-elements", a.blade_elements, "beam elements per blade")->capture_default_str();
    app.add_option("--tower-elements", a.tower_elements, "beam elements of the tower")->capture_default_str();
    app.add_flag("--no-teeter", a.no_teeter, "teeter locked");
    app.add_flag("--gravity", a.gravity, "with gravity: the steady state is periodic");
    app.add_option("--harmonics", a.harmonics, "of the revolution in the steady state")->capture_default_str();
    auto* frequency = app.add_option("--max-frequency", a.max_frequency, "follow modes up to this frequency, Hz")
                          ->capture_default_str();
    app.add_option("--max-per-rev", a.max_per_rev, "follow modes up to this multiple of the first rotor speed")
        ->excludes(frequency);
    app.add_flag("--modes", a.modes,
                 "also draw mode shapes at the first and last rotor speed (PREFIX_modes/*.svg, *.png)");
    app.add_option("--out", a.out, "prefix of the files")->capture_default_str();
    app.add_option("--data", a.data, "folder with teetered.csv (default: built in)");
    app.add_flag("--summary", a.summary, "print bodies, coordinates and masses first");
    return program::parse(app, argc, argv);
}

turbines::TeeteredTurbine machine(const Arguments& a) {
    turbines::TeeteredDescription description = a.data.empty()
                                                    ? turbines::teetered_description()
                                                    : turbines::teetered_description(std::filesystem::path(a.data));
    if (!a.rigid_tower) description = turbines::with_tower_rigidity(description, a.tower_ratio);
    turbines::TeeteredOptions options;
    options.tower.elements = a.tower_elements;
    options.blade.elements = a.blade_elements;
    options.tower.torsion_armature = options.blade.torsion_armature = -1. / 12;  // torsion of fourth order
    options.rigid_tower = a.rigid_tower;
    options.teeter_locked = a.no_teeter;
    if (a.gravity) options.gravity = {0, 0, -9.80665};
    return turbines::assemble(description, options);
}

solvers::CampbellOptions options(const Arguments& a, const turbines::TeeteredTurbine& turbine, double first_speed) {
    solvers::CampbellOptions options;
    options.method = solvers::CampbellMethod::floquet;
    options.floquet.odd = turbine.half_turn_odd();
    options.floquet.harmonics = a.harmonics;
    options.max_frequency_hz = a.max_per_rev ? *a.max_per_rev * first_speed / (2 * pi) : a.max_frequency;
    options.progress = program::speed_progress;
    options.cancelled = program::interrupted;
    return options;
}

int run(const Arguments& a) {
    const std::vector<double> speeds = program::rotor_speeds(a.rpm);
    const turbines::TeeteredTurbine turbine = machine(a);
    if (a.summary) std::cout << turbine.summary() << "\n";
    for (const std::string& warning : turbine.warnings()) std::cerr << "warning: " << warning << "\n";
    program::check_outputs(a.out, {".h5", ".csv", ".svg", ".png"});
    const solvers::Campbell diagram =
        solvers::campbell(turbine.system(), turbine.rotor(), speeds, options(a, turbine, speeds.front()));
    program::stop_at_once();
    std::cout << solvers::table(diagram) << std::flush;
    if (!std::cout) throw FileError("standard output", "the table could not be written");
    if (diagram.points.empty()) return 130;
    solvers::write_hdf5(diagram, a.out + ".h5");
    solvers::write_csv(diagram, a.out + ".csv");
    for (const char* kind : {".svg", ".png"}) solvers::plot(diagram, a.out + kind);
    if (a.modes && diagram.complete) program::draw_modes(diagram, a.out + "_modes");
    std::cout << "\nfiles: " << a.out << ".h5, .csv, .svg, .png"
              << (a.modes ? text("; mode shapes in ", a.out, "_modes/") : "") << "\n";
    return diagram.complete ? 0 : 130;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("teetered_campbell", argc, argv, parse, run);
}
