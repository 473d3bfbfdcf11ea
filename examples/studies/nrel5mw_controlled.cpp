// The NREL 5 MW machine under its baseline controller.
//
// Problem: the elastic machine, its pitch bearings turned by actuators, the torque of its generator set. The library
// has no aerodynamics: the rotor is driven by a torque that depends on wind and pitch as table 7-1 of the report of the
// machine says. Five studies: steps of the wind through all regions of the controller; frequency and damping of the
// speed loop, by the design in the report, by eigenvalues of the closed loop in continuous time, and as the response to
// a step shows them under the program that is called every 12.5 ms; a damper of the drive train by the generator's
// torque; frequencies and damping over the wind, with the loop open and closed; a doubly-fed generator as a circuit in
// a sag of the voltage. Reference: J. Jonkman, S. Butterfield, W. Musial, G. Scott, NREL/TP-500-38060, 2009, section 7.
// Checked: the energy balance; steady operation after each step; the response against the eigenvalue, 1 % of the
// frequency and 0.01 of the damping ratio.
#include "examples/studies/nrel5mw_controlled/studies.hpp"
#include "programs/shared/program.hpp"

using namespace cardan;

namespace {

struct Arguments {
    controlled::MachineOptions machine;
    controlled::StepsOptions steps;
    controlled::LoopOptions loop;
    controlled::DamperStudy damper;
    controlled::DiagramOptions diagram;
    controlled::SagOptions sag;
    std::string out = "nrel5mw_controlled", study;
};

void add_machine_options(program::CommandLine& app, Arguments& a) {
    controlled::MachineOptions& m = a.machine;
    app.add_option("--variant", m.variant, "data of the machine, see nrel5mw_campbell")
        .one_of({"report", "fast", "beamdyn"});
    app.add_option("--blade-elements", m.blade_elements, "beam elements per blade");
    app.add_option("--tower-elements", m.tower_elements, "beam elements of the tower");
    app.add_option("--out", a.out, "prefix of the files");
}

void add_steps(program::CommandLine& app, Arguments& a) {
    controlled::StepsOptions& o = a.steps;
    program::CommandLine study =
        app.add_subcommand("steps",
                           "Steps of the wind: speed, pitch, torque and power, beside those of steady operation.\n"
                           "Writes PREFIX.h5, .svg, .png and _energy.png.");
    study.fallthrough();
    study.add_option("--winds", o.winds, "that follow one another, m/s, separated by commas, 7 ... 25");
    study.add_option("--every", o.every, "how long each of them blows, s");
    study.add_option("--step", o.step, "time between outputs, s");
    study.add_option("--tolerance", o.tolerance, "relative tolerance of a step");
    study.add_option("--gain", o.gain, "of a damper of the drive train, N m s/rad; 0: none");
}

void add_loop(program::CommandLine& app, Arguments& a) {
    controlled::LoopOptions& o = a.loop;
    program::CommandLine study = app.add_subcommand(
        "loop",
        "Frequency and damping of the speed loop: as designed, of the rigid and the elastic machine by "
        "eigenvalues, and as the response to a\nstep of the torque shows them. Writes PREFIX.svg and "
        ".png.");
    study.fallthrough();
    study.add_option("--winds", o.winds, "m/s, separated by commas, above rated");
    study.add_option("--change", o.change, "step of the wind, m/s");
    study.add_option("--duration", o.duration, "of the response, s");
}

void add_damper(program::CommandLine& app, Arguments& a) {
    controlled::DamperStudy& o = a.damper;
    program::CommandLine study = app.add_subcommand(
        "damper",
        "A damper of the drive train: a part of the generator's speed, band-passed about the frequency of the drive "
        "train, is added to its torque.\nDamping without and with it; twist of the main shaft after a step of the "
        "torque. Writes PREFIX.svg and .png.");
    study.fallthrough();
    study.add_option("--wind", o.wind, "m/s");
    study.add_option("--gain", o.gain, "of the damper, N m s/rad of the generator");
    study.add_option("--width", o.width, "damping ratio of its band pass");
    study.add_option("--change", o.change, "step of the wind, m/s");
    study.add_option("--duration", o.duration, "of the response, s");
}

void add_diagram(program::CommandLine& app, Arguments& a) {
    controlled::DiagramOptions& o = a.diagram;
    program::CommandLine study =
        app.add_subcommand("campbell",
                           "Frequencies and damping over the wind, with pitch and torque held and under the controller "
                           "in continuous time.\nWrites PREFIX_open.svg, PREFIX_closed.svg and .png.");
    study.fallthrough();
    study.add_option("--winds", o.winds, "m/s, separated by commas, above rated");
    study.add_option("--max", o.max_frequency, "largest frequency, Hz");
}

void add_sag(program::CommandLine& app, Arguments& a) {
    controlled::SagOptions& o = a.sag;
    program::CommandLine study = app.add_subcommand(
        "sag",
        "The machine with a doubly-fed generator as a circuit, its converter under the controller, in a "
        "sag of the grid's voltage.\nWrites PREFIX.h5, .svg, .png and _energy.png.");
    study.fallthrough();
    study.add_option("--wind", o.wind, "m/s");
    study.add_option("--depth", o.depth, "part of the voltage that is lost");
    study.add_option("--at", o.at, "time of the sag, s");
    study.add_option("--for", o.lasts, "how long it lasts, s");
    study.add_option("--duration", o.duration, "simulated time, s");
    study.add_option("--step", o.step, "time between outputs, s");
    study.add_option("--tolerance", o.tolerance, "relative tolerance of a step");
}

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "The NREL 5 MW machine under its baseline controller. No aerodynamics: the torque of the rotor depends on wind "
        "and pitch as\nthe report of the machine says. No gravity. nrel5mw_controlled STUDY --help lists the options "
        "of "
        "a study.");
    app.footer(
        "Exit code: 0; 1 error, or the energy balance does not close; 2 wrong usage; 3 the machine has not settled, "
        "the "
        "response\nshows another frequency or damping than the eigenvalue, the damper does not damp, or the closed "
        "loop "
        "is not stable at\nrated speed; 130 interrupted.");
    add_machine_options(app, a);
    add_steps(app, a);
    add_loop(app, a);
    add_damper(app, a);
    add_diagram(app, a);
    add_sag(app, a);
    if (const int code = app.parse(argc, argv); code >= 0) return code;
    a.study = app.subcommand();
    return -1;
}

int run(const Arguments& a) {
    if (a.study == "steps") return controlled::steps(a.machine, a.steps, a.out);
    if (a.study == "loop") return controlled::loop(a.machine, a.loop, a.out);
    if (a.study == "sag") return controlled::sag(a.machine, a.sag, a.out);
    if (a.study == "campbell") return controlled::diagram(a.machine, a.diagram, a.out);
    return controlled::damper(a.machine, a.damper, a.out);
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("nrel5mw_controlled", argc, argv, parse, run);
}
