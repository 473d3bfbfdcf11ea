#include "turbines/analysis/detail/simulation_model.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/analysis/controlled_machine.hpp"
#include "turbines/analysis/detail/model_run.hpp"
#include "turbines/analysis/detail/run_loads.hpp"
#include "turbines/analysis/machine_wind.hpp"
#include "turbines/analysis/steady_rotation.hpp"
#include "turbines/analysis/wind_run.hpp"
#include "turbines/machine/wind_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan::turbines {

namespace {

// Out of balance by less, in rad or m, a steady state is good enough to start from.
constexpr double good_start = 1e-6;

// Beside `turbine`, the machine in the mean of the wind.
struct InTheAir {
    Turbine turbine, at_start;
    std::optional<MachineAir> air = {}, air_at_start = {};
    StartGuess guess = {};
};

SteadyRotationOptions rotation_options(const StartGuess& guess, const SimulationSettings& o) {
    return {.good = good_start,
            .start = guess.q,
            .state_start = guess.states,
            .azimuths = guess.azimuths,
            .cancelled = o.cancelled};
}

// A machine whose air does not lag, as it turns steadily or stands; undeformed where it does neither.
struct SteadyMotion {
    std::vector<DynamicState> revolution;
    Matrix coefficients;
};
SteadyMotion steady_motion(const Turbine& turbine, const MachineAir& air, const SimulationSettings& o) {
    const double speed = *o.rotor_speed;
    const int azimuths = std::max(24, air.min_azimuths());
    try {
        if (speed == 0) {
            const DynamicState still = standstill(turbine, *o.azimuth);
            return {{still}, still.q};
        }
        const solvers::PeriodicSteadyState found =
            steady_rotation(turbine, speed, rotation_options({.azimuths = air.min_azimuths()}, o));
        SteadyMotion motion{{}, found.coefficients};
        for (int i = 0; i < azimuths; ++i) motion.revolution.push_back(found.at(2 * pi * i / azimuths));
        return motion;
    } catch (const NumericalError&) {
        if (o.cancelled && o.cancelled()) throw;
        DynamicState undeformed = at_rest(Eigen::Index{turbine.system().model.size()});
        undeformed.qd(turbine.rotor().spin) = speed;
        return {{undeformed}, {}};
    }
}

InTheAir in_air_that_lags(const Turbine& machine, const MachineAir& steady, const AeroelasticOptions& models,
                          const SimulationSettings& o) {
    const MachineAir in_mean_wind = steady.in(steady.wind().mean());
    const Model& model = machine.system().model;
    const MachineAir at_rest = in_mean_wind.lagging({.airfoils = models.airfoils, .airfoils_at_rest = true});
    const SteadyMotion motion = steady_motion(at_rest.on(machine), at_rest, o);
    const MachineAir at_start = air_about(in_mean_wind, model, motion.revolution, models);
    const MachineAir run = at_start.in(steady.wind());
    InTheAir out{run.on(machine), at_start.on(machine), run, at_start};
    out.guess = {.q = motion.coefficients, .azimuths = steady.min_azimuths()};
    if (at_start.states() > 0)
        out.guess.states =
            at_start.with_states(states_about(at_start, model, motion.revolution), out.at_start.system().forces);
    return out;
}

InTheAir in_the_air(const Turbine& turbine, const Machine& machine, const SimulationSettings& o, const Report& report) {
    if (o.wind->is_none()) return {turbine, turbine};
    const Aerodynamics air = air_of(machine, o.air);
    report_remark(report, {Remark::Kind::taken, text("air of the run: ", turbines::in_words(air.model))});
    const Wind wind = wind_of(*o.wind, wind_site(turbine, machine, o.air, air.density), report);
    if (!wind.is_steady()) report_remark(report, {Remark::Kind::taken, turbines::in_words(wind)});
    const MachineAir steady(turbine, air.blade, wind, air.options, support_on(turbine, machine, air.support));
    const AeroelasticOptions models = aeroelastic_options(air);
    if (models.wake == Wake::oye || models.wake == Wake::frozen || !models.airfoils.empty())
        return in_air_that_lags(turbine, steady, models, o);
    const MachineAir in_mean_wind = steady.in(wind.mean());
    return {steady.on(turbine), in_mean_wind.on(turbine), steady, in_mean_wind, {.azimuths = steady.min_azimuths()}};
}

solvers::PeriodicSteadyState rotation_in_wind(const InTheAir& machine, const SimulationSettings& o,
                                              const Report& report) {
    try {
        return steady_rotation(machine.at_start, *o.rotor_speed, rotation_options(machine.guess, o), report);
    } catch (const NumericalError& error) {
        throw NumericalError(text(error.what(), "; give the generator's torque: SimulationSettings::generator_torque"));
    }
}

// About the shaft, mean over a revolution in steady rotation, N m. That rotation is a better guess of the start.
double driving_torque(InTheAir& machine, const SimulationSettings& o, const Report& report) {
    if (*o.rotor_speed == 0) return 0;
    const MachineAir& air = *machine.air_at_start;
    const int azimuths = std::max(24, air.min_azimuths());
    const solvers::PeriodicSteadyState state = rotation_in_wind(machine, o, report);
    const Model& model = machine.at_start.system().model;
    Workspace workspace(model);
    double sum = 0;
    for (int i = 0; i < azimuths; ++i) {
        const DynamicState at = state.at(2 * pi * i / azimuths);
        const Kinematics kin = kinematics(model, at.q, workspace);
        const ElementValues values = air.values(StateView(at, kin), machine.at_start.system().forces);
        sum += air.rotor(values.view()).moment.x();
    }
    machine.guess.q = state.coefficients;
    machine.guess.states = state.state_coefficients;
    return sum / azimuths;
}

SimulationModel uncontrolled(const SimulationSettings& o, const InTheAir& machine, double rotor_torque,
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

SimulationModel controlled(const SimulationSettings& o, const InTheAir& machine, double rotor_torque,
                           const std::vector<ChannelGroup>& measured, const Report& report) {
    const MachineLayout& layout = machine.turbine.layout();
    const double own =
        start_torque(o.controller, layout.gear_ratio, {*o.rotor_speed, layout.pitch_settings.front(), rotor_torque});
    ControlledMachine under =
        controlled_machine(o.controller, machine.turbine,
                           {.torque = o.generator_torque.value_or(own), .also_measured = measured, .report = report});
    report_remark(report, {Remark::Kind::taken, text("controller: ", under.pitch)});
    return {.turbine = under.turbine,
            .at_start = machine.at_start,
            .controllers = {std::move(under.controller)},
            .channels = {std::move(under.channels)}};
}

void add_rotor_torque(const RotorTorque& torque, SimulationModel& model) {
    if (!torque.acts()) return;
    model.turbine = with_rotor_torque(model.turbine, torque);
    model.at_start = with_first_rotor_torque(model.at_start, torque);
    model.channels.push_back(rotor_torque_channels(torque, model.turbine.layout().hub));
}

// At the start, N m, as far as it is the generator's to balance.
double torque_to_balance(const Machine& machine, const SimulationSettings& o, InTheAir& in_air, const Report& report) {
    if (in_air.air && !o.generator_torque && dofs_of(machine.description).generator)
        return driving_torque(in_air, o, report);
    return !in_air.air && o.controller.acts() && o.rotor_torque.acts() ? o.rotor_torque.values.front() : 0;
}

// Empty, with the reason reported: there is no steady state, or it was not found.
std::optional<DynamicState> steady_start(const SimulationModel& model, const SimulationSettings& o,
                                         const Report& report) {
    const double speed = *o.rotor_speed, azimuth = *o.azimuth;
    const StartGuess& guess = model.guess;
    try {
        if (speed != 0) return steady_rotation(model.at_start, speed, rotation_options(guess, o), report).at(azimuth);
        return standstill(model.at_start, azimuth, guess.states.size() > 0 ? Vector(guess.states.col(0)) : Vector());
    } catch (const NumericalError& error) {
        if (o.cancelled && o.cancelled()) throw;
        report_remark(report, {.text = text("the start is undeformed: ", error.what())});
        return std::nullopt;
    }
}

// Straight, the states as in the guess.
DynamicState undeformed(const SimulationModel& model) {
    DynamicState at = at_rest(Eigen::Index{model.at_start.system().model.size()});
    at.s = model.guess.states.size() > 0 ? Vector(model.guess.states.col(0))
                                         : model.at_start.system().forces.states().initial();
    return at;
}

// Those of the machine at the start where it has them as well, the others as their table says.
Vector states_of(const Turbine& turbine, const Turbine& at_start, const Vector& states) {
    const StateTable& table = turbine.system().forces.states();
    const StateTable& known = at_start.system().forces.states();
    Vector all = table.initial();
    for (int i = 0; i < table.size(); ++i)
        if (const int own = known.find(table[i].name); own >= 0) all(i) = states(own);
    return all;
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
    InTheAir in_air = in_the_air(ready.turbine, machine, o, report);
    const TorqueLaw law = torque_law_of(machine, o);
    const double driving = law.acts() ? 0 : torque_to_balance(machine, o, in_air, report);
    const std::optional<MachineAir>& air = in_air.air;
    std::vector<ChannelGroup> wind;
    if (air) wind.push_back(air->channels());
    SimulationModel model =
        o.controller.acts() ? controlled(o, in_air, driving, wind, report) : uncontrolled(o, in_air, driving, law);
    model.guess = in_air.guess;
    model.channels.insert(model.channels.end(), wind.begin(), wind.end());
    add_rotor_torque(o.rotor_torque, model);
    if (air) {
        model.wind = to_yaml(air->wind());
        if (air->wind().box() != nullptr) model.check_wind = air->wind().box()->data().require_unchanged;
    }
    return model;
}

SimulationState start_of(const SimulationModel& model, const SimulationSettings& o, const Report& report) {
    const Turbine& turbine = model.turbine;
    const int spin = turbine.rotor().spin;
    std::optional<DynamicState> at;
    if (o.start == SimulationStart::steady) at = steady_start(model, o, report);
    if (!at) at = undeformed(model);
    SimulationState start{at->q, at->qd, states_of(turbine, model.at_start, at->s)};
    start.q(spin) = *o.azimuth;
    start.qd(spin) = *o.rotor_speed;
    const CoordinateTable& table = turbine.system().model.coordinates();
    set_named(o.q, "SimulationSettings::q", table, start.q);
    set_named(o.qd, "SimulationSettings::qd", table, start.qd);
    return start;
}

}  // namespace cardan::turbines
