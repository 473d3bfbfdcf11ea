// The 600 kW machine with its induction generator as a circuit.
//
// Problem: bodies, and fluxes of stator and rotor, in one system of equations (turbines/electric/electric_wt600.hpp).
// Three motions in time, with gravity and a prescribed load on the rotor (no aerodynamics): a direct start from
// standstill; the grid lost for a moment and back; a sag of its voltage. And the damping that the generator gives the
// torsion of the drive train, by models of all orders beside the slope of its steady curve. Checks: the balance of
// energy of bodies and of fields; steady operation before a disturbance.
#include "examples/studies/drive_train.hpp"
#include "examples/studies/wt600_simulation.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/program.hpp"
#include "programs/shared/simulation_run.hpp"
#include "programs/shared/words.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/pictures/campbell.hpp"
#include "turbines/electric/electric_wt600.hpp"
#include "turbines/model/generator_slip.hpp"

#include <cmath>
#include <cstdio>
#include <iostream>
#include <numeric>
#include <optional>
#include <string>

using namespace cardan;

namespace {

struct MotionOptions {
    program::RunArguments run;  ///< duration 0: that of the study
    int blade_elements = 3, tower_elements = 3;
    int order = 5;
    double wind = 11.86, at = 1, lasts = 0.15, depth = 0.5;
};

MachineOrder order_of(int order) {
    if (order == 5) return MachineOrder::fifth;
    if (order == 3) return MachineOrder::third;
    if (order == 1) return MachineOrder::first;
    throw InputError("--order", "order of the generator's model", order, "5, 3 or 1");
}

turbines::ElectricWt600Options machine_options(const std::string& study, const MotionOptions& o) {
    turbines::ElectricWt600Options options;
    const Vec3 gravity = options.assembly.gravity;
    options.assembly = program::elements_of_paper(o.blade_elements, o.tower_elements);
    options.assembly.gravity = gravity;
    options.order = order_of(o.order);
    options.wind = study == "start" ? 0 : o.wind;
    if (study == "loss") options.grid = options.grid.with_interruption(o.at, o.lasts);
    if (study == "sag") options.grid = options.grid.with_sag(o.depth, o.at, o.lasts);
    return options;
}

// The machine with the steady curve in place of the circuit: it has no states, and bends in the same way.
turbines::Wt600Operation with_curve(const turbines::ElectricWt600Options& options, bool gravity) {
    turbines::Wt600OperationOptions other;
    other.assembly = options.assembly;
    other.wind = options.wind;
    if (!gravity) other.assembly.gravity.setZero();
    return turbines::wt600_operation(other);
}

struct ElectricStart {
    program::Start motion;
    Vector states;
};

ElectricStart standing(const turbines::ElectricWt600Options& options) {
    const turbines::ElectricWt600 machine = turbines::electric_wt600(options);
    return {program::standing_start(with_curve(options, true)), machine.turbine.system().forces.states().initial()};
}

// Rotor and generator balance: the steady state of bodies and fields without gravity, and what gravity bends.
ElectricStart running(turbines::ElectricWt600Options options) {
    const turbines::Wt600Operation curve = with_curve(options, true), calm_curve = with_curve(options, false);
    options.assembly.gravity.setZero();
    const double synchronous = turbines::wt600_equivalent_circuit().synchronous_speed();
    options.running = 1.01 * synchronous;
    const turbines::ElectricWt600 calm = turbines::electric_wt600(options);
    const int spin = calm.turbine.rotor().spin;
    solvers::SteadyOptions steady;
    steady.rotor_speed = 1.01 * synchronous / calm.turbine.layout().gear_ratio;
    steady.trim.emplace();
    const solvers::SteadyState state = solvers::steady_state(calm.turbine.system(), spin, steady);
    require_result(state, "start of the simulation");
    const double speed = state.at.qd(spin);
    program::Start start = program::rotating_start(curve, calm_curve, speed);
    start.q += state.at.q - program::steady_position(calm_curve.turbine, calm_curve.turbine.forces(), speed, 0);
    return {start, state.at.s};
}

const char* title(const std::string& study) {
    if (study == "start") return "direct start of the 600 kW machine";
    return study == "loss" ? "600 kW machine, grid lost and back" : "600 kW machine, sag of the voltage";
}

// Currents exist in the models of fifth and third order.
std::vector<solvers::HistoryPanel> panels(int order) {
    std::vector<solvers::HistoryPanel> all{{{"RotSpeed"}}, {{"GenTq"}}, {{"generator power"}}};
    if (order > 1) {
        all.push_back({{"generator reactive power"}});
        all.push_back({{"generator current"}});
        all.push_back({{"generator voltage"}});
    }
    all.push_back({{"RotTorq"}});
    return all;
}

// @param study  "start", "loss" or "sag"
int motion(const std::string& study, const MotionOptions& given) {
    MotionOptions o = given;
    const bool from_rest = study == "start";
    if (o.run.duration == 0) o.run.duration = from_rest ? 30 : 6;
    program::check_run_options(o.run);
    if (!from_rest) {
        require_not_negative("--at", "value [s]", o.at);
        require_positive("--for", "value [s]", o.lasts);
    }
    program::check_outputs(o.run.out, program::run_outputs);
    const turbines::ElectricWt600Options options = machine_options(study, o);
    const turbines::ElectricWt600 machine = turbines::electric_wt600(options);
    const ElectricStart start = from_rest ? standing(options) : running(options);
    solvers::IntegrationOptions integration = program::integration_options(o.run);
    integration.states = start.states;
    solvers::Integrator integrator(machine.turbine.system(), {}, 0, start.motion.q, start.motion.qd, integration);
    solvers::Recorder recorder(integrator, machine.channels);
    program::Rows rows(title(study),
                       text("order ", o.order, ", ", program::options_text(o.run), "\n", machine.turbine.summary()),
                       o.run, integrator, recorder);
    const program::Stopwatch watch;
    const solvers::Advance end = program::record(integrator, recorder, 0, o.run.duration, o.run.step, rows);
    const program::Elapsed elapsed = watch.elapsed();
    program::progress("\r                              \r");

    std::vector<const char*> extremes{"RotSpeed", "GenTq", "RotTorq", "generator power", "RootMxb1", "TTDspSS"};
    if (o.order > 1) extremes.insert(extremes.begin() + 3, "generator current");
    program::print_largest(rows.history(), extremes);
    std::printf("\n");
    const solvers::EnergyBalance energy = integrator.energy();
    const double scale = program::largest(rows.history(), "kinetic energy").value;
    bool good = program::check_energy(energy, scale, 10 * o.run.tolerance);
    if (o.order == 5) good = program::check_field_energy(energy, rows.history(), 10 * o.run.tolerance) && good;
    if (!from_rest && end.reached())
        good = program::check("start in equilibrium: change of rotor speed before the disturbance",
                              program::speed_drift(rows.history(), o.at), 1e-3) &&
               good;
    program::print_effort(integrator, machine.turbine.system(), elapsed);
    program::write_outputs(rows, o.run.out, end.reached(), panels(o.order), {}, {});
    if (!end.reached()) return 130;
    return good ? 0 : 1;
}

struct DampingOptions {
    std::string speeds = "10,15,20,25,30,33";  ///< rpm
    double max_frequency = 8;                  ///< Hz
};

// No wind and no torque, the grid's frequency that of the rotor, its voltage in proportion.
turbines::Turbine machine_at(const MotionOptions& o, std::optional<MachineOrder> order, double speed) {
    if (!order)
        return turbines::with_generator_slip(
            turbines::wt600(program::elements_of_paper(o.blade_elements, o.tower_elements)),
            turbines::wt600_kloss_curve());
    turbines::ElectricWt600Options options;
    options.assembly = program::elements_of_paper(o.blade_elements, o.tower_elements);
    options.wind = 0;
    options.order = *order;
    const double ratio = turbines::wt600_description().drive_train.gear_ratio,
                 share = speed * ratio / turbines::wt600_equivalent_circuit().synchronous_speed();
    options.grid.frequency *= share;
    options.grid.line_voltage *= share;
    options.running = speed * ratio;
    return turbines::electric_wt600(options).turbine;
}

solvers::Mode torsion_at(const turbines::Turbine& turbine, double speed) {
    const solvers::SteadyState steady =
        solvers::steady_state(turbine.system(), turbine.rotor().spin, {.rotor_speed = speed});
    require_result(steady, "steady state");
    const solvers::SecondOrderSystem system = program::multi_blade_system(turbine, steady.at);
    return program::drive_train_mode(turbine, system, solvers::modes(system), 8);
}

int damping(const MotionOptions& machine, const DampingOptions& options) {
    const std::vector<double> speeds = program::numbers("--speeds", options.speeds, "numbers separated by commas, rpm");
    for (const double rpm : speeds) require_positive("--speeds", "rotor speed [rpm]", rpm);
    program::check_outputs(machine.run.out, {".svg", ".png"});
    std::printf("torsion of the drive train, Hz, and damping ratio, %%\n%6s %17s %17s %17s %17s\n", "rpm",
                "steady curve", "first order", "third order", "fifth order");
    std::vector<turbines::Turbine> fifth;
    for (const double rpm : speeds) {
        std::printf("%6.1f", rpm);
        for (const std::optional<MachineOrder> order :
             {std::optional<MachineOrder>(), std::optional(MachineOrder::first), std::optional(MachineOrder::third),
              std::optional(MachineOrder::fifth)}) {
            const turbines::Turbine turbine = machine_at(machine, order, rpm * units::rpm);
            const solvers::Mode mode = torsion_at(turbine, rpm * units::rpm);
            std::printf(" %8.4f %8.3f", mode.natural_hz(), 100 * mode.damping_ratio());
            if (order == MachineOrder::fifth) fifth.push_back(turbine);
        }
        std::printf("\n");
    }
    std::vector<solvers::CampbellCase> cases;
    cases.reserve(speeds.size());
    for (std::size_t i = 0; i < speeds.size(); ++i)
        cases.push_back({&fifth[i].system(), &fifth[i].rotor(), speeds[i] * units::rpm, speeds[i]});
    solvers::CampbellOptions campbell;
    campbell.method = solvers::CampbellMethod::coleman;
    campbell.max_frequency_hz = options.max_frequency;
    const solvers::Campbell diagram = solvers::campbell(cases, "rotor speed, rpm", campbell);
    std::cout << "\n" << solvers::table(diagram);
    for (const char* ending : {".svg", ".png"}) solvers::plot(diagram, machine.run.out + ending);
    std::printf("\nfiles: %s.svg, .png\n", machine.run.out.c_str());
    return 0;
}

struct Arguments {
    MotionOptions motion;
    DampingOptions damping;
    std::string study;
};

void add_motion(program::CommandLine& app, MotionOptions& o, const char* name, const char* what) {
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
    if (a.study == "damping") return damping(a.motion, a.damping);
    return motion(a.study, a.motion);
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("wt600_electric", argc, argv, parse, run);
}
