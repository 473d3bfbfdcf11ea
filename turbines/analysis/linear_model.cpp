#include "turbines/analysis/linear_model.hpp"

#include "mbs/base/error.hpp"
#include "solvers/linear_models/multi_blade_model.hpp"
#include "turbines/analysis/detail/linear_forms.hpp"
#include "turbines/analysis/linear_signals.hpp"
#include "turbines/analysis/machine_wind.hpp"
#include "turbines/analysis/prepared_machine.hpp"
#include "turbines/analysis/steady_rotation.hpp"
#include "turbines/machine/machine_text.hpp"
#include "turbines/model/channels.hpp"

#include <cmath>
#include <utility>

namespace cardan::turbines {

namespace {

constexpr int harmonics_without_wind = 8, harmonics_in_wind = 4;

void check(const LinearModelSettings& s) {
    require_not_negative("LinearModelSettings::rotor_speed", "value [rad/s]", s.rotor_speed.value_or(0));
    require_not_negative("LinearModelSettings::wind", "value [m/s]", s.wind.value_or(0));
    if (s.max_frequency_hz)
        require_positive("LinearModelSettings::max_frequency_hz", "value [Hz]", *s.max_frequency_hz);
    require_positive("LinearModelSettings::error", "value", s.error);
    if (s.azimuths < 1 || s.azimuths > 720)
        throw InputError("LinearModelSettings::azimuths", "value", s.azimuths, "1 ... 720");
    if (s.harmonics && (*s.harmonics < 1 || *s.harmonics > 200))
        throw InputError("LinearModelSettings::harmonics", "value", *s.harmonics, "1 ... 200");
    if (s.wind && s.rotor_speed)
        throw InputError("LinearModelSettings::rotor_speed", "value [rad/s]", *s.rotor_speed,
                         "none beside a wind: see MachineOperation::schedule");
}

// Inputs and channels beside those of any machine.
struct More {
    std::vector<solvers::LinearInput> inputs = {};
    std::vector<ChannelGroup> channels = {};
};

// @param state  steady: periodic, or constant but for the azimuth
template <class State>
solvers::LinearModel linearised_about(const Turbine& turbine, const LinearModelSettings& s, solvers::RotorSpin spin,
                                      const State& state, const More& more) {
    solvers::StateSpaceOptions options;
    options.azimuths = s.azimuths;
    options.spin = spin;
    std::vector<solvers::LinearInput> inputs = linear_inputs(turbine, spin);
    inputs.insert(inputs.end(), more.inputs.begin(), more.inputs.end());
    std::vector<ChannelGroup> further = station_channels(turbine, s.stations);
    further.insert(further.end(), more.channels.begin(), more.channels.end());
    options.outputs = s.outputs;
    if (s.outputs.empty()) {
        options.outputs = linear_outputs(turbine);
        for (const ChannelGroup& group : further)
            for (const Channel& channel : group.channels) options.outputs.push_back(channel.name);
    }
    std::vector<ChannelGroup> groups = channels(turbine);
    groups.insert(groups.end(), further.begin(), further.end());
    return solvers::state_space(turbine.system(), turbine.rotor(), state, named_inputs(std::move(inputs), s.inputs),
                                groups, options);
}

// A parked rotor, blade 1 up.
DynamicState standing(const AeroelasticPoint& point) {
    solvers::SteadyOptions options;
    options.initial = point.start.col(0);
    if (point.state_start.cols() > 0) options.states = point.state_start.col(0);
    const solvers::SteadyState state =
        solvers::steady_state(point.machine.system(), point.machine.rotor().spin, options);
    require_result(state);
    return state.at;
}

solvers::LinearModel about_operating_point(const AeroelasticPoint& point, const LinearModelSettings& s,
                                           solvers::RotorSpin spin) {
    const Turbine& turbine = point.machine;
    solvers::LinearInput::Coordinates toward_feather;
    for (const BodyId drive : turbine.layout().pitch_drives)
        toward_feather.emplace_back(turbine.system().model.index(drive), -1.0);
    const More more{{solvers::LinearInput::system_input(wind_input),
                     solvers::LinearInput::motion("collective pitch", toward_feather)},
                    {point.air.channels()}};
    const double speed = *s.rotor_speed;
    if (speed == 0) return linearised_about(turbine, s, spin, standing(point), more);
    return linearised_about(turbine, s, spin, steady_state(point, speed, *s.harmonics), more);
}

MachineLinearModel at_rotor_speed(const Machine& machine, LinearModelSettings s) {
    s.rotor_speed = rotor_speed_of(s.rotor_speed, machine, "LinearModelSettings::rotor_speed", s.report);
    s.machine.pitch = pitch_at_speed(s.machine.pitch, machine, *s.rotor_speed, s.report);
    const PreparedTurbine ready = assembled(machine, assembly_options(machine, s.machine, s.gravity),
                                            *s.max_frequency_hz, std::abs(*s.rotor_speed), s.report);
    report_remark(s.report, {Remark::Kind::taken, in_words(ready.mesh)});
    solvers::LinearModel model = linearised(ready.turbine, s, rotor_spin(machine));
    return {.model = std::move(model), .turbine = ready.turbine, .settings = std::move(s), .mesh = ready.mesh};
}

MachineLinearModel at_operating_point(const Machine& machine, LinearModelSettings s) {
    WindRun run = wind_run(machine, {.winds = {*s.wind},
                                     .operation = s.operation,
                                     .air = s.air,
                                     .machine = s.machine,
                                     .gravity = s.gravity,
                                     .harmonics = *s.harmonics,
                                     .azimuths = s.azimuths,
                                     .max_frequency_hz = *s.max_frequency_hz,
                                     .report = s.report,
                                     .cancelled = s.cancelled});
    report_remark(s.report, {Remark::Kind::taken, in_words(run.ready.mesh)});
    find_points(run);
    if (run.points.empty()) throw NumericalError(text("no operating point at ", *s.wind, " m/s"));
    AeroelasticOptions air = aeroelastic_options(run.air);
    report_remark(s.report, {Remark::Kind::taken, text("air of the vibrations: ", turbines::in_words(run.air.model))});
    air.wind_input = true;
    s.rotor_speed = run.points.front().operation.rotor_speed;
    s.machine = run.options.machine;
    const AeroelasticPoint point = aeroelastic(run.operation, run.points.front(), air);
    solvers::LinearModel model = about_operating_point(point, s, rotor_spin(machine));
    const Mesh mesh = run.ready.mesh;
    return {.model = std::move(model),
            .turbine = point.machine,
            .in_wind = std::move(run),
            .settings = std::move(s),
            .mesh = mesh};
}

}  // namespace

// Periodic under gravity, else constant but for the azimuth where there is such a state.
solvers::LinearModel linearised(const Turbine& turbine, const LinearModelSettings& s, solvers::RotorSpin spin) {
    const double speed = *s.rotor_speed;
    // Before the equilibrium is sought, which takes long.
    check_size(turbine);
    const auto about_periodic = [&] {
        return linearised_about(
            turbine, s, spin,
            steady_rotation(turbine, speed,
                            {.harmonics = s.harmonics.value_or(harmonics_without_wind), .cancelled = s.cancelled},
                            s.report),
            {});
    };
    if (s.gravity && speed != 0) return about_periodic();
    solvers::SteadyState state;
    try {
        solvers::SteadyOptions options;
        options.rotor_speed = speed;
        state = solvers::steady_state(turbine.system(), turbine.rotor().spin, options);
        require_result(state);
    } catch (const NumericalError&) {
        if (speed == 0) throw;
        return about_periodic();
    }
    return linearised_about(turbine, s, spin, state.at, {});
}

const solvers::ConstantModel& MachineLinearModel::constant_model(const std::string& name) const {
    std::string allowed;
    for (const solvers::NamedModel& one : constant) {
        if (one.name == name) return one.model;
        allowed += text(allowed.empty() ? "" : ", ", one.name);
    }
    throw InputError("constant model", "name", name, allowed);
}

MachineLinearModel linear_model(const Machine& source, const LinearModelSettings& settings) {
    check(settings);
    LinearModelSettings s = settings;
    std::vector<Remark> remarks;
    s.report = kept(remarks, settings.report);
    if (!s.harmonics) s.harmonics = s.wind ? harmonics_in_wind : harmonics_without_wind;
    const Machine machine = with_settings(source, s.machine, s.report);
    s.machine.foundation.reset();  // it is the machine's now
    if (s.wind || s.rotor_speed.value_or(machine.operation.rotor_speed) != 0)
        solvers::check_azimuths(static_cast<std::size_t>(s.azimuths),
                                machine.description.individual_blades.empty() ? machine.description.blades : 1);
    if (!s.max_frequency_hz)
        s.max_frequency_hz = usual_frequency(machine.description, assembly_options(machine, s.machine, s.gravity));
    MachineLinearModel linear =
        s.wind ? at_operating_point(machine, std::move(s)) : at_rotor_speed(machine, std::move(s));
    keep_elements(linear.mesh, linear.settings.machine);
    linear.settings.report = settings.report;
    if (linear.in_wind) linear.in_wind->options.report = settings.report;
    linear.model.description = with_machine(linear.model.description, machine);
    add_constant_forms(linear, machine.description);
    linear.remarks = std::move(remarks);
    return linear;
}

}  // namespace cardan::turbines
