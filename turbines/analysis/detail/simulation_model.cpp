#include "turbines/analysis/detail/simulation_model.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/analysis/controlled_machine.hpp"
#include "turbines/analysis/detail/model_run.hpp"
#include "turbines/analysis/detail/run_loads.hpp"
#include "turbines/analysis/machine_wind.hpp"
#include "turbines/analysis/steady_rotation.hpp"
#include "turbines/machine/wind_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan::turbines {

namespace {

// Out of balance by less, in rad or m, a steady state is good enough to start from.
constexpr double good_start = 1e-6;

struct Pair {
    Turbine turbine, at_start;
};

Pair in_the_air(const Turbine& machine, const std::optional<MachineAir>& air) {
    if (!air) return {machine, machine};
    return {air->on(machine), air->in(air->wind().mean()).on(machine)};
}

std::optional<MachineAir> air_on(const Turbine& turbine, const Machine& machine, const SimulationSettings& o,
                                 const Report& report) {
    if (o.wind->is_none()) return std::nullopt;
    const Aerodynamics air = air_of(machine, o.air);
    report_remark(report, {Remark::Kind::taken, text("air of the run: ", air_in_equilibrium(air))});
    const WindSite site = wind_site(turbine, machine, o.air, air.density);
    const Wind wind = wind_of(*o.wind, site, report);
    if (!wind.is_steady()) report_remark(report, {Remark::Kind::taken, turbines::in_words(wind)});
    return MachineAir(turbine, air.blade, wind, air.options, support_on(turbine, machine, air.support));
}

solvers::PeriodicSteadyState rotation_in_wind(const Turbine& at_start, const SimulationSettings& o,
                                              const Report& report) {
    try {
        return steady_rotation(at_start, *o.rotor_speed, {.good = good_start, .cancelled = o.cancelled}, report);
    } catch (const NumericalError& error) {
        throw NumericalError(text(error.what(), "; give the generator's torque: SimulationSettings::generator_torque"));
    }
}

// About the shaft, mean over a revolution in steady rotation, N m.
double torque_of(const MachineAir& air, const Turbine& at_start, const SimulationSettings& o, const Report& report) {
    if (*o.rotor_speed == 0) return 0;
    const int azimuths = std::max(24, air.min_azimuths());
    const solvers::PeriodicSteadyState state = rotation_in_wind(at_start, o, report);
    const Model& model = at_start.system().model;
    Workspace workspace(model);
    double sum = 0;
    for (int i = 0; i < azimuths; ++i) {
        const DynamicState at = state.at(2 * pi * i / azimuths);
        const Kinematics kin = kinematics(model, at.q, workspace);
        sum += air.rotor(StateView(at, kin)).moment.x();
    }
    return sum / azimuths;
}

SimulationModel uncontrolled(const SimulationSettings& o, const Pair& machine, double rotor_torque,
                             const TorqueLaw& law) {
    const double ratio = machine.turbine.layout().gear_ratio;
    const GeneratorLoad generator{o.generator_torque.value_or(rotor_torque / ratio),
                                  o.generator_slope,
                                  ratio * *o.rotor_speed,
                                  ratio,
                                  *machine.turbine.layout().generator,
                                  law};
    SimulationModel model{with_generator(machine.turbine, generator), with_generator(machine.at_start, generator)};
    if (generator.acts()) model.channels.push_back(generator_channels(generator));
    return model;
}

SimulationModel controlled(const SimulationSettings& o, const Pair& machine, double rotor_torque,
                           const std::vector<ChannelGroup>& measured, const Report& report) {
    const MachineLayout& layout = machine.turbine.layout();
    const double own =
        start_torque(o.controller, layout.gear_ratio, {*o.rotor_speed, layout.pitch_settings.front(), rotor_torque});
    ControlledMachine under =
        controlled_machine(o.controller, machine.turbine,
                           {.torque = o.generator_torque.value_or(own), .also_measured = measured, .report = report});
    report_remark(report, {Remark::Kind::taken, text("controller: ", under.pitch)});
    return {under.turbine, machine.at_start, {std::move(under.controller)}, {std::move(under.channels)}};
}

void add_rotor_torque(const RotorTorque& torque, SimulationModel& model) {
    if (!torque.acts()) return;
    model.turbine = with_rotor_torque(model.turbine, torque);
    model.at_start = with_first_rotor_torque(model.at_start, torque);
    model.channels.push_back(rotor_torque_channels(torque, model.turbine.layout().hub));
}

// At the start, N m, as far as it is the generator's to balance.
double driving_torque(const Machine& machine, const SimulationSettings& o, const std::optional<MachineAir>& air,
                      const Turbine& at_start, const Report& report) {
    if (air && !o.generator_torque && dofs_of(machine.description).generator)
        return torque_of(*air, at_start, o, report);
    return !air && o.controller.acts() && o.rotor_torque.acts() ? o.rotor_torque.values.front() : 0;
}

// Empty, with the reason reported: there is no steady state, or it was not found.
std::optional<SimulationState> steady_start(const Turbine& turbine, const SimulationSettings& o, const Report& report) {
    const double speed = *o.rotor_speed, azimuth = *o.azimuth;
    try {
        const DynamicState at =
            speed == 0
                ? standstill(turbine, azimuth)
                : steady_rotation(turbine, speed, {.good = good_start, .cancelled = o.cancelled}, report).at(azimuth);
        return SimulationState{at.q, at.qd};
    } catch (const NumericalError& error) {
        if (o.cancelled && o.cancelled()) throw;
        report_remark(report, {.text = text("the start is undeformed: ", error.what())});
        return std::nullopt;
    }
}

void set_named(const std::map<std::string, double>& named, const char* field, const CoordinateTable& table,
               Vector& values) {
    for (const auto& [name, value] : named) {
        if (!std::isfinite(value)) throw InputError(field, name, value, "finite");
        values(table.index(name)) = value;
    }
}

}  // namespace

SimulationModel simulation_model(const Machine& machine, const SimulationSettings& o, Mesh& mesh,
                                 const Report& report) {
    const AssemblyOptions assembly = assembly_options(machine, o.machine, o.gravity);
    const PreparedTurbine ready =
        assembled(machine, assembly, usual_frequency(machine.description, assembly), std::abs(*o.rotor_speed), report);
    mesh = ready.mesh;
    report_remark(report, {Remark::Kind::taken, in_words(mesh)});
    const std::optional<MachineAir> air = air_on(ready.turbine, machine, o, report);
    const Pair pair = in_the_air(ready.turbine, air);
    const TorqueLaw law = torque_law_of(machine, o);
    const double driving = law.acts() ? 0 : driving_torque(machine, o, air, pair.at_start, report);
    std::vector<ChannelGroup> wind;
    if (air) wind.push_back(air->channels());
    SimulationModel model =
        o.controller.acts() ? controlled(o, pair, driving, wind, report) : uncontrolled(o, pair, driving, law);
    model.channels.insert(model.channels.end(), wind.begin(), wind.end());
    add_rotor_torque(o.rotor_torque, model);
    if (air) {
        model.wind = to_yaml(air->wind());
        if (air->wind().box() != nullptr) model.check_wind = air->wind().box()->data().require_unchanged;
    }
    return model;
}

SimulationState start_of(const Turbine& at_start, const SimulationSettings& o, const Report& report) {
    const System& system = at_start.system();
    const int spin = at_start.rotor().spin;
    std::optional<SimulationState> start;
    if (o.start == SimulationStart::steady) start = steady_start(at_start, o, report);
    if (!start) start = {Vector::Zero(system.model.size()), Vector::Zero(system.model.size())};
    start->q(spin) = *o.azimuth;
    start->qd(spin) = *o.rotor_speed;
    const CoordinateTable& table = system.model.coordinates();
    set_named(o.q, "SimulationSettings::q", table, start->q);
    set_named(o.qd, "SimulationSettings::qd", table, start->qd);
    return *std::move(start);
}

}  // namespace cardan::turbines
