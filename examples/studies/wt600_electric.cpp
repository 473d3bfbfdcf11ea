// The 600 kW machine with its induction generator as a circuit.
//
// Problem: bodies, and fluxes of stator and rotor, in one system of equations (turbines/electric/electric_wt600.hpp).
// Three motions in time, with gravity and a prescribed load on the rotor (no aerodynamics): a direct start from
// standstill; the grid lost for a moment and back; a sag of its voltage. And the damping that the generator gives the
// torsion of the drive train, by models of all orders beside the slope of its steady curve. Checks: the balance of
// energy of bodies and of fields; steady operation before a disturbance.
#include "examples/studies/wt600_electric/damping.hpp"
#include "examples/studies/wt600_electric/motion.hpp"
#include "programs/shared/program.hpp"

using namespace cardan;

namespace {

struct Arguments {
    electric::MotionOptions motion;
    electric::DampingOptions damping;
    std::string study;
};

void add_motion(program::CommandLine& app, electric::MotionOptions& o, const char* name, const char* what) {
    program::CommandLine study = app.add_subcommand(name, what);
    study.fallthrough();
    study.add_option("--duration", o.run.duration, "simulated time, s (default: 30 for start, 6 otherwise)")
        .hide_default();
    study.add_option("--step", o.run.step, "time between outputs, s");
    study.add_option("--tolerance", o.run.tolerance, "relative tolerance of a step");
    study.add_option("--order", o.order, "order of the generator's model: 5, 3 or 1");
    if (std::string(name) == "start") return;
    study.add_option("--wind", o.wind, "wind speed, m/s");
    study.add_option("--at", o.at, "time of the disturbance, s");
    study.add_option("--for", o.lasts, "how long it lasts, s");
    if (std::string(name) == "sag")
        study.add_option("--depth", o.depth, "of the sag: part of the voltage that is lost");
}

int parse(int argc, char** argv, Arguments& a) {
    a.motion.run.duration = 0;  // that of the study
    a.motion.run.step = 0.005;
    a.motion.run.out = "wt600_electric";
    program::CommandLine app(
        "The 600 kW machine with its induction generator as a circuit: fluxes of stator and rotor beside the bodies. "
        "No "
        "aerodynamics.\nwt600_electric STUDY --help lists the options of a study.");
    app.footer("Exit code: 0; 1 error, or a balance of energy does not close; 2 wrong usage; 130 interrupted.");
    app.add_option("--blade-elements", a.motion.blade_elements, "beam elements per blade");
    app.add_option("--tower-elements", a.motion.tower_elements, "beam elements of the tower");
    app.add_option("--out", a.motion.run.out, "prefix of the files");
    add_motion(app, a.motion, "start",
               "Direct start: the standing machine is put on the grid.\nWrites PREFIX.h5, .svg, .png and _energy.png.");
    add_motion(app, a.motion, "loss",
               "The grid is lost at rated wind, and comes back.\nWrites PREFIX.h5, .svg, .png and _energy.png.");
    add_motion(app, a.motion, "sag",
               "Sag of the voltage at rated wind.\nWrites PREFIX.h5, .svg, .png and _energy.png.");
    program::CommandLine damping = app.add_subcommand(
        "damping",
        "Frequency and damping of the torsion of the drive train over the rotor speed, the frequency of the grid "
        "following "
        "it at constant flux:\nby the slope of the steady curve and by models of first, third and fifth order. Writes "
        "PREFIX.svg and .png,\nthe diagram with the model of fifth order.");
    damping.fallthrough();
    damping.add_option("--speeds", a.damping.speeds, "rotor speeds, rpm, separated by commas");
    damping.add_option("--max", a.damping.max_frequency, "largest frequency of the diagram, Hz");
    if (const int code = app.parse(argc, argv); code >= 0) return code;
    a.study = app.subcommand();
    return -1;
}

int run(const Arguments& a) {
    if (a.study == "damping") return electric::damping(a.motion, a.damping);
    return electric::motion(a.study, a.motion);
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("wt600_electric", argc, argv, parse, run);
}
