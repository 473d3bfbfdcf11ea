#include "examples/studies/nrel5mw_controlled/machine.hpp"

#include "elements/controllers/variable_speed_equivalent.hpp"
#include "examples/studies/drive_train.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/outcome.hpp"
#include "mbs/kernels/metric.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "turbines/reference_turbines/nrel5mw_controller.hpp"

#include <cmath>
#include <map>

namespace cardan::controlled {

namespace {

turbines::Turbine machine(const MachineOptions& options, double pitch) {
    using turbines::Nrel5mwVariant;
    const std::map<std::string, Nrel5mwVariant> variants{
        {"report", Nrel5mwVariant::report}, {"fast", Nrel5mwVariant::fast}, {"beamdyn", Nrel5mwVariant::beamdyn}};
    const Nrel5mwVariant variant = variants.at(options.variant);
    turbines::TurbineDescription description = turbines::nrel5mw_description(turbines::nrel5mw_options(variant));
    turbines::give_pitch_springs(description);
    turbines::AssemblyOptions assembly =
        turbines::nrel5mw_assembly(variant, options.blade_elements, options.tower_elements);
    assembly.pitch = pitch;
    return turbines::assemble(description, assembly);
}

RotorLoad rotor_of(const turbines::Turbine& turbine, std::function<double(double)> wind) {
    const turbines::MachineLayout& layout = turbine.layout();
    RotorLoad load{.name = "rotor", .hub = layout.hub, .azimuth = layout.azimuth};
    for (const BodyId pitch : layout.pitch)
        load.pitch.emplace_back(pitch, -1 / static_cast<double>(layout.pitch.size()));
    load.pitch_setting = layout.pitch_settings.front();
    load.wind = wind;
    load.law = [wind = std::move(wind)](double time, double, double, double pitch) {
        return rotor_torque(wind(time), pitch);
    };
    return load;
}

ForceSet with_load(ForceSet forces, const RotorLoad& load) {
    forces.add_element(rotor_load_force(load));
    return forces;
}

// Pitch and torque of the generator held.
turbines::Turbine loaded(const turbines::Turbine& turbine, const RotorLoad& load) {
    return turbine.with_forces(with_load(turbine.forces(), load));
}

// The torque that it adds; its element is put into the forces.
ControlSignal add_damper(const DamperOptions& damper, const Plant& plant, ForceSet& forces) {
    if (damper.gain == 0) return signal::constant(0);
    const turbines::MachineLayout& layout = plant.turbine.layout();
    const ControlBlock band = second_order_filter({.name = {.name = "drive-train damper",
                                                            .unit = "rad/s",
                                                            .scale = 1,
                                                            .initial = layout.gear_ratio * plant.point.rotor_speed,
                                                            .part = "controller"},
                                                   .input = turbines::generator_speed(layout),
                                                   .frequency = damper.frequency,
                                                   .damping = damper.width,
                                                   .band_pass = true});
    forces.add_element(band.element);
    return damper.gain * band.output;
}

}  // namespace

Plant plant(const MachineOptions& options, double wind) {
    const SteadyPoint point = steady_point(wind);
    const turbines::Turbine turbine = machine(options, point.pitch);
    const RotorLoad rotor = rotor_of(turbine, [wind](double) { return wind; });
    const turbines::Turbine held = loaded(turbine, rotor);
    const solvers::SteadyState state =
        solvers::steady_state(held.system(), turbine.rotor().spin, {.rotor_speed = point.rotor_speed});
    require_result(state, "steady state");
    return {turbine, point, rotor, state.at};
}

turbines::ActuatorOptions pitch_actuators() {
    return {.pitch_frequency = 2 * pi * 2, .pitch_damping = 0.7, .max_pitch_rate = 8 * units::degree};
}

turbines::Turbine open_loop(const Plant& plant) {
    return loaded(plant.turbine, plant.rotor);
}

RotorLoad rotor_in_wind(const Plant& plant, const std::function<double(double)>& wind) {
    return rotor_of(plant.turbine, wind);
}

turbines::ControlledMachine sampled_machine(const Plant& plant, const std::function<double(double)>& wind,
                                            const DamperOptions& damper, const turbines::ActuatorOptions& actuators) {
    ForceSet forces = with_load(plant.turbine.forces(), rotor_in_wind(plant, wind));
    const ControlSignal more = add_damper(damper, plant, forces);
    turbines::Controller controller = turbines::Controller::baseline();
    controller.parameters = turbines::nrel5mw_controller();
    controller.period = controller.parameters->period;
    controller.generator_efficiency = 0.944;
    controller.individual_pitch = false;
    controller.actuators = actuators;
    return turbines::controlled_machine(controller, plant.turbine.with_forces(forces),
                                        {.torque = plant.point.torque, .more_torque = more});
}

LinearLoop linear_loop(const Plant& plant, const DamperOptions& damper) {
    const turbines::MachineLayout& layout = plant.turbine.layout();
    const VariableSpeedParameters parameters = turbines::nrel5mw_controller();
    const VariableSpeedEquivalent loop =
        variable_speed_equivalent(parameters, {turbines::generator_speed(layout), turbines::mean_pitch(layout)},
                                  {layout.gear_ratio * plant.point.rotor_speed, plant.point.pitch});
    ForceSet more;
    const ControlSignal damping = add_damper(damper, plant, more);
    turbines::ActuatorOptions actuators = pitch_actuators();
    actuators.max_torque_rate = parameters.max_torque_rate;
    ForceSet forces = turbines::ActuatedForces(plant.turbine, actuators)
                          .with_demands({{loop.pitch}, loop.torque + damping}, plant.point.torque);
    for (const ForceElement& element : more.elements()) forces.add_element(element);
    for (const ControlBlock* block : {&loop.filter, &loop.integral}) forces.add_element(block->element);
    const turbines::Turbine turbine = plant.turbine.with_forces(with_load(forces, plant.rotor));

    DynamicState at = plant.start;
    at.s = turbine.system().forces.states().initial();
    at.u = {};
    LinearLoop out{turbine, program::multi_blade_system(turbine, at), {}};
    out.modes = solvers::modes(out.system);
    return out;
}

double rotor_inertia(const Plant& plant) {
    const Model& model = plant.turbine.system().model;
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, plant.start.q, workspace);
    Matrix g(model.size(), model.size());
    metric(kin, g);
    const int spin = plant.turbine.rotor().spin;
    return g(spin, spin);
}

solvers::Mode drive_train_mode(const LinearLoop& loop) {
    return program::drive_train_mode(loop.turbine, loop.system, loop.modes, 5);
}

}  // namespace cardan::controlled
