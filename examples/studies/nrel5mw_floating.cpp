// The NREL 5 MW machine on a floating platform, the OC3-Hywind spar.
//
// Problem: the whole elastic machine under gravity stands on a rigid spar with six degrees of freedom, held by its
// weights, by the water (linear hydrostatics, constant added mass, linear damping) and by linearised mooring lines; no
// waves, no wind. Three studies: modes of the free-floating machine at some rotor speeds, beside the machine with the
// spar held and the one on land; decay tests, period and damping as measured in the time history beside the eigenvalue;
// prescribed motions of the spar and what they do to deflections and loads.
// Reference: pitch at 0.034 Hz (J. Jonkman, docs/nrel5mw_floating.md). Checked: the energy balance; periods of the
// decays within 1 % of the eigenvalues, if enough cycles were measured.
#include "examples/studies/motion_option.hpp"
#include "examples/studies/nrel5mw_floating/studies.hpp"
#include "programs/shared/program.hpp"
#include "programs/shared/simulation.hpp"

using namespace cardan;

namespace {

struct Arguments {
    floating::MachineOptions machine;
    floating::ModesOptions modes;
    floating::DecayOptions decay;
    floating::MotionOptions motion;
    std::string out = "nrel5mw_floating", study;
};

constexpr std::array<const char*, 6> directions{
    "downwind, m",
    "to the left, looking downwind, m",
    "up, m",
    "about the downwind axis, deg",
    "about the sway axis, deg: positive moves the top of the tower downwind",
    "about the tower axis, deg"};

void add_machine_options(program::CommandLine& app, Arguments& a) {
    floating::MachineOptions& m = a.machine;
    app.add_option("--variant", m.variant, "data of the machine, see nrel5mw_campbell")
        .one_of({"report", "fast", "beamdyn"});
    app.add_option("--blade-elements", m.blade_elements, "beam elements per blade");
    app.add_option("--tower-elements", m.tower_elements, "beam elements of the tower");
    app.add_flag("--undamped", m.undamped, "leave out the damping of the structure");
    app.add_option("--data", m.data,
                   "folder with oc3_hywind_platform.csv, oc3_hywind_tower.csv and nrel5mw_*.csv (default: built in)");
    app.add_option("--out", a.out, "prefix of the files");
}

void add_modes(program::CommandLine& app, Arguments& a) {
    floating::ModesOptions& o = a.modes;
    program::CommandLine study = app.add_subcommand(
        "modes",
        "Free-floating modes: Campbell diagram under gravity (mean of the multi-blade system over the azimuth), "
        "platform modes,\nfrequencies beside the modes of the machine on the held spar and on land that are nearest in "
        "shape.\nWrites PREFIX.h5, .csv, .svg, .png, _families.png and _difference.png (free less held, without "
        "doubtful pairs).");
    study.fallthrough();
    study.add_option("--rpm", o.rpm, "rotor speeds, numbers and FIRST:LAST:STEP separated by commas, rev/min");
    study.add_option("--max-frequency", o.max_frequency, "follow modes up to this frequency, Hz");
    study.add_option("--names", o.names, "of modes: as reports print them, or Cardan's own")
        .one_of({"community", "descriptive"});
    study.add_flag("--modes", o.shapes, "also draw mode shapes at the first and last rotor speed (PREFIX_modes/)");
    study.add_flag("--summary", o.summary, "print bodies, coordinates and masses first");
}

void add_integration(program::CommandLine& study, double& step, double& tolerance, std::string& method) {
    study.add_option("--step", step, "time between outputs, s");
    study.add_option("--tolerance", tolerance, "relative tolerance of a step, at most 1e-4");
    study.add_option("--method", method, "method of integration").one_of(program::method_names);
}

void add_decay(program::CommandLine& app, Arguments& a) {
    floating::DecayOptions& o = a.decay;
    program::CommandLine study = app.add_subcommand(
        "decay",
        "Decay tests: from the equilibrium one coordinate of the free spar is displaced and let go; period and damping "
        "measured\nin the time history (logarithmic decrement) beside the eigenvalue of the linear model.\nWrites "
        "PREFIX_<coordinate>.h5, .svg and .png.");
    study.fallthrough();
    study.add_option("--from", o.from,
                     "COORDINATE=VALUE with surge, sway, heave (m), roll, pitch, yaw (deg), several, each once; all: "
                     "3 m or 3 deg");
    study.add_option("--rpm", o.rpm, "rotor speed, rev/min");
    study.add_option("--cycles", o.cycles, "of the linear model that are simulated");
    add_integration(study, o.step, o.tolerance, o.method);
}

void add_motion(program::CommandLine& app, Arguments& a) {
    floating::MotionOptions& o = a.motion;
    program::CommandLine study =
        app.add_subcommand("motion",
                           "Prescribed harmonic motion of the spar: deflections and loads beside those "
                           "on the still spar. Motions that are "
                           "given act\ntogether; without any each coordinate moves in turn. Amplitudes "
                           "at the motions' periods are fitted together with\nthose at the sums and "
                           "differences with multiples of the rotor's frequency. Writes PREFIX.csv and "
                           "PREFIX_<case>.h5,\n.png.\n" +
                               std::string(program::motion_help));
    study.fallthrough();
    const auto motions = program::add_motion_options(study, floating::coordinate_names, directions, o.motions);
    for (program::Option in_turn : {study.add_option("--amplitude", o.amplitude, "of the motions in turn, m or deg"),
                                    study.add_option("--period", o.period, "of the motions in turn, s")})
        for (const program::Option& motion : motions) in_turn.excludes(motion);
    study.add_option("--rpm", o.rpm, "rotor speed, rev/min");
    study.add_option("--settle", o.settle, "time that is left out, s; in its first half the motion is faded in");
    study.add_option("--periods", o.periods, "of the slowest motion that are looked at then").range(1, 100000);
    add_integration(study, o.step, o.tolerance, o.method);
}

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "The NREL 5 MW machine on the OC3-Hywind spar: modes of the free-floating machine, decay tests, prescribed "
        "motion.\n"
        "Axes and signs are those of OpenFAST: x downwind, y to the left, z up; positive pitch moves the top "
        "downwind.\n"
        "No waves, no wind. nrel5mw_floating STUDY --help lists the options of a study.");
    app.footer(
        "Exit code: 0; 1 error, or the energy balance does not close; 2 wrong usage; 3 the period of a decay is not "
        "within 1 % of\nthe linear model's; 130 interrupted: what was computed is written.");
    add_machine_options(app, a);
    add_modes(app, a);
    add_decay(app, a);
    add_motion(app, a);
    if (const int code = app.parse(argc, argv); code >= 0) return code;
    a.study = app.subcommand();
    return -1;
}

int run(const Arguments& a) {
    if (a.study == "modes") return floating::free_modes(a.machine, a.modes, a.out);
    if (a.study == "decay") return floating::decay(a.machine, a.decay, a.out);
    return floating::motion(a.machine, a.motion, a.out);
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("nrel5mw_floating", argc, argv, parse, run);
}
