#include "examples/studies/wt600_electric/motion.hpp"

#include "examples/studies/wt600_simulation.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/electric/electric_wt600.hpp"

#include <cmath>
#include <cstdio>

namespace cardan::electric {

namespace {

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

}  // namespace

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

}  // namespace cardan::electric
