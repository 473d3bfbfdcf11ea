#include "examples/studies/nrel5mw_controlled/studies.hpp"
#include "mbs/base/error.hpp"
#include "programs/shared/simulation_run.hpp"
#include "turbines/electric/nrel5mw_generator.hpp"
#include "turbines/model/channels.hpp"

#include <cmath>
#include <cstdio>

namespace cardan::controlled {

namespace {

struct Machine {
    turbines::ControlledMachine controlled;
    DoublyFedGenerator generator;
};

// The torque actuator is what the controller's demand goes through; the converter follows it.
Machine machine_in_sag(const Plant& plant, const SagOptions& options) {
    turbines::ActuatorOptions actuators = pitch_actuators();
    actuators.torque_on_shaft = false;
    turbines::ControlledMachine machine = sampled_machine(
        plant, [wind = options.wind](double) { return wind; }, {}, actuators);
    const turbines::MachineLayout& layout = machine.turbine.layout();
    DoublyFedGenerator generator = turbines::nrel5mw_doubly_fed(layout);
    generator.grid = generator.grid.with_sag(options.depth, options.at, options.lasts);
    generator.torque = signal::state(turbines::torque_state);
    generator.running_speed = layout.gear_ratio * plant.point.rotor_speed;
    generator.running_torque = plant.point.torque;
    ForceSet forces = machine.turbine.forces();
    forces.add_element(doubly_fed_generator(generator));
    machine.turbine = machine.turbine.with_forces(forces);
    return {std::move(machine), std::move(generator)};
}

}  // namespace

int sag(const MachineOptions& machine, const SagOptions& options, const std::string& out) {
    require_not_negative("--at", "value [s]", options.at);
    require_positive("--for", "value [s]", options.lasts);
    winds("--wind", text(options.wind));
    program::RunArguments run;
    run.duration = options.duration;
    run.step = options.step;
    run.tolerance = options.tolerance;
    run.out = out;
    program::check_run_options(run);
    program::check_outputs(out, program::run_outputs);
    const Plant start = plant(machine, options.wind);
    const Machine own = machine_in_sag(start, options);
    const turbines::Turbine& turbine = own.controlled.turbine;
    solvers::IntegrationOptions integration = program::integration_options(run);
    integration.controllers = {own.controlled.controller};
    solvers::Integrator integrator(turbine.system(), {}, 0, start.start.q, start.start.qd, integration);
    const RotorLoad rotor = rotor_in_wind(start, [wind = options.wind](double) { return wind; });
    std::vector<ChannelGroup> channels = turbines::channels(turbine);
    channels.push_back(own.controlled.channels);
    channels.push_back(doubly_fed_generator_channels(own.generator));
    solvers::Recorder recorder(integrator, std::move(channels));
    program::Rows rows(
        "NREL 5 MW machine with a doubly-fed generator under the baseline controller, sag of the voltage",
        text("wind ", options.wind, " m/s, sag ", options.depth, " at ", options.at, " s for ", options.lasts, " s, ",
             program::options_text(run), "\n", turbine.rotor().description),
        run, integrator, recorder);
    const program::Stopwatch watch;
    const solvers::Advance end = program::record(integrator, recorder, 0, run.duration, run.step, rows);
    const program::Elapsed elapsed = watch.elapsed();
    program::progress("\r                              \r");
    program::print_largest(rows.history(), {"RotSpeed", "GenTq", "RotTorq", "doubly-fed generator power",
                                            "doubly-fed generator current", "doubly-fed generator rotor voltage"});
    std::printf("\n");
    const solvers::EnergyBalance energy = integrator.energy();
    const double scale = program::largest(rows.history(), "kinetic energy").value;
    bool good = program::check_energy(energy, scale, 10 * options.tolerance);
    good = program::check_field_energy(energy, rows.history(), 10 * options.tolerance) && good;
    if (end.reached())
        good = program::check("start in equilibrium: change of rotor speed before the sag",
                              program::speed_drift(rows.history(), options.at), 1e-3) &&
               good;
    program::print_effort(integrator, turbine.system(), elapsed);
    program::write_outputs(rows, out, end.reached(),
                           {{{"RotSpeed"}},
                            {{"torque demand", "GenTq"}},
                            {{"doubly-fed generator power"}},
                            {{"doubly-fed generator reactive power"}},
                            {{"doubly-fed generator current"}},
                            {{"doubly-fed generator rotor voltage"}},
                            {{"RotTorq"}}},
                           {}, {});
    if (!end.reached()) return 130;
    return good ? 0 : 1;
}

}  // namespace cardan::controlled
