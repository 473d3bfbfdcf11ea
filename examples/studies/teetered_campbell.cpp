// Campbell diagram of the two-bladed teetered machine.
//
// Problem: the machine of Lee, Hodges and Patil, Wind Energy 5 (2002), Table I, free to yaw and to teeter. Two blades
// make its equations periodic, whatever the coordinates: at every rotor speed the periodic steady state is found by
// harmonic balance, the equations are linearised about it, and Floquet's theory gives the motions, with frequencies
// that prevail (tower modes in the fixed frame, blade modes in the rotating frame), damping and stability. Reference:
// frequencies at 6.02 rad/s (57.5 rev/min) in docs/verification.md.
#include "examples/studies/teetered_program.hpp"

#include <iostream>
#include <optional>

using namespace cardan;

namespace {

struct Arguments {
    std::string rpm = "10:80:2.5", out = "teetered_campbell";
    program::TeeteredArguments machine;
    double max_frequency = 12;
    std::optional<double> max_per_rev;
    bool modes = false;
};

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "Campbell diagram of the two-bladed teetered machine (Lee, Hodges, Patil 2002) by Floquet's theory.\n"
        "Writes PREFIX.h5, PREFIX.csv, PREFIX.svg and PREFIX.png, and prints a table.");
    app.add_option("--rpm", a.rpm, text("rotor speeds, ", program::rpm_format, "; nominal 57.5"));
    a.machine.blade_elements = a.machine.tower_elements = 3;
    program::add_options(app, a.machine);
    const program::Option frequency =
        app.add_option("--max-frequency", a.max_frequency, "follow modes up to this frequency, Hz");
    app.add_option("--max-per-rev", a.max_per_rev, "follow modes up to this multiple of the first rotor speed")
        .excludes(frequency);
    app.add_flag("--modes", a.modes,
                 "also draw mode shapes at the first and last rotor speed (PREFIX_modes/*.svg, *.png)");
    app.add_option("--out", a.out, "prefix of the files");
    return app.parse(argc, argv);
}

// In rotation.
double first_speed(const std::vector<double>& speeds) {
    return speeds.front() > 0 || speeds.size() == 1 ? speeds.front() : speeds[1];
}

int run(const Arguments& a) {
    const std::vector<double> speeds = program::rotor_speeds(a.rpm);
    const turbines::Turbine turbine = program::machine(a.machine);
    program::introduce(turbine, a.machine.summary);
    program::check_outputs(a.out, {".h5", ".csv", ".svg", ".png"});
    const double max_frequency = a.max_per_rev ? *a.max_per_rev * first_speed(speeds) / (2 * pi) : a.max_frequency;
    solvers::Campbell diagram = solvers::campbell(turbine.system(), turbine.rotor(), speeds,
                                                  program::campbell_options(a.machine, turbine, max_frequency));
    program::tell_elements(diagram, turbine);
    program::stop_at_once();
    program::print_table(diagram);
    if (diagram.points.empty()) return 130;
    program::write_files(diagram, a.out, {.title = text(diagram.machine, ", ", diagram.remark)});
    if (a.modes && diagram.complete) program::draw_modes(diagram, a.out + "_modes");
    std::cout << "\nfiles: " << a.out << ".h5, .csv, .svg, .png"
              << (a.modes ? text("; mode shapes in ", a.out, "_modes/") : "") << "\n";
    return diagram.complete ? 0 : 130;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("teetered_campbell", argc, argv, parse, run);
}
