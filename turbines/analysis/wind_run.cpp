#include "turbines/analysis/wind_run.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/analysis/detail/rounded.hpp"
#include "turbines/analysis/machine_wind.hpp"

#include <algorithm>
#include <utility>

namespace cardan::turbines {

namespace {

void take(const Report& report, const std::string& words) {
    report_remark(report, {Remark::Kind::taken, words});
}

std::string in_words(const VariableSpeed& law, const std::string& source) {
    const std::string pitch =
        law.least_pitch.empty() ? digits(law.fine_pitch * units::to_degrees) + " deg" : "at least as scheduled";
    return text("operation: tip-speed ratio ", digits(law.tip_speed_ratio, std::chars_format::fixed, 3), ", ",
                rounded(law.least_speed * units::to_rpm), " to ", rounded(law.rated_speed * units::to_rpm),
                " rpm, pitch ", pitch, "; ", rounded(law.rated_power / 1e3), " kW on the rotor from rated wind on",
                source.empty() ? "" : text(" (", source, ")"));
}

bool sets_law(const OperationSettings& own) {
    return own.tip_speed_ratio || own.rated_power || own.rated_rotor_speed || own.min_rotor_speed;
}

// What the settings say, else the controller of the machine.
VariableSpeed law_of(const WindRun& run) {
    const OperationSettings& own = run.options.operation;
    const TurbineDescription& d = run.machine.description;
    VariableSpeed law = variable_speed(run.machine.operation);
    if (own.rated_rotor_speed) law.rated_speed = *own.rated_rotor_speed;
    if (own.min_rotor_speed) law.least_speed = *own.min_rotor_speed;
    if (own.rated_power) law.rated_power = *own.rated_power;
    law.fine_pitch = run.options.machine.pitch.value_or(0);
    if (!run.own_pitch) law.least_pitch.clear();
    if (own.tip_speed_ratio)
        law.tip_speed_ratio = *own.tip_speed_ratio;
    else if (law.tip_speed_ratio == 0)
        law.tip_speed_ratio =
            best_tip_speed_ratio(run.air.blade, d.blades, d.blade.cone, law.fine_pitch, run.air.options);
    if (law.rated_power == 0)
        throw InputError("OperationSettings::rated_power", "value", "none, and the model names none",
                         "power of the air on the rotor at rated wind; or a schedule of the machine");
    if (law.rated_speed == 0)
        throw InputError("OperationSettings::rated_rotor_speed", "value", "none, and the model names none",
                         "speed of the rotor from rated wind on; or a schedule of the machine");
    take(run.options.report, in_words(law, run.machine.operation.source));
    return law;
}

std::vector<Operation> scheduled(const WindRun& run) {
    const std::vector<Operation>& schedule = run.machine.operation.schedule;
    take(run.options.report, text("operation: as scheduled over the wind, ", rounded(schedule.front().wind), " to ",
                                  rounded(schedule.back().wind), " m/s"));
    std::vector<Operation> wanted;
    wanted.reserve(run.options.winds.size());
    for (const double wind : run.options.winds) wanted.push_back(operation_at(schedule, wind));
    return wanted;
}

WindOperationOptions operation_options(const Machine& machine, const WindRunOptions& o, const Aerodynamics& air,
                                       const Turbine& turbine) {
    WindOperationOptions in_wind;
    in_wind.wind = wind_profile(turbine, machine, o.air, air.density);
    in_wind.air = air.options;
    in_wind.support = support_on(turbine, machine, air.support);
    in_wind.harmonics = o.harmonics;
    in_wind.azimuths = o.azimuths;
    in_wind.progress = [progress = o.progress, cancelled = o.cancelled, total = static_cast<int>(o.winds.size()),
                        done = 0](const WindPoint&) mutable {
        if (progress) progress(++done, total);
        return !cancelled || !cancelled();
    };
    return in_wind;
}

}  // namespace

WindRun wind_run(const Machine& source, const WindRunOptions& options) {
    WindRunOptions o = options;
    Machine machine = with_settings(source, o.machine, o.report);
    Aerodynamics air = air_of(machine, o.air);
    const bool own_pitch = !o.machine.pitch;
    if (own_pitch && machine.operation.min_pitch.empty())
        o.machine.pitch = pitch_at_speed({}, machine, machine.operation.rotor_speed, o.report);
    const AssemblyOptions assembly = assembly_options(machine, o.machine, o.gravity);
    PreparedTurbine ready = assembled(machine, assembly, o.max_frequency_hz, machine.operation.rotor_speed, o.report);
    keep_elements(ready.mesh, o.machine);
    WindOperationOptions in_wind = operation_options(machine, o, air, ready.turbine);
    WindOperation operation(machine.description, assembly_options(machine, o.machine, o.gravity), air.blade, in_wind);
    return {.machine = std::move(machine),
            .options = std::move(o),
            .own_pitch = own_pitch,
            .air = std::move(air),
            .ready = std::move(ready),
            .in_wind = std::move(in_wind),
            .operation = std::move(operation)};
}

void find_points(WindRun& run) {
    const WindRunOptions& o = run.options;
    take(o.report, text("air of the operating points: ", air_in_equilibrium(run.air)));
    const bool by_law = run.machine.operation.schedule.empty() || sets_law(o.operation);
    std::vector<WindPoint> all = by_law ? run.operation.over(o.winds, law_of(run)) : run.operation.over(scheduled(run));
    run.complete = all.size() == o.winds.size() && (!o.cancelled || !o.cancelled());
    for (WindPoint& point : all) {
        if (!point.converged) {
            report_remark(o.report, {Remark::Kind::warning, text("not converged: ", point.message)});
            run.not_converged.push_back(point.operation.wind);
            continue;
        }
        run.truncation_residual = std::max(run.truncation_residual, point.remainder);
        run.points.push_back(std::move(point));
    }
}

FinerPoint finer_point(const WindRun& run, const Operation& at) {
    MachineSettings settings = run.options.machine;
    settings.blade_elements = 2 * run.ready.mesh.blade_elements;
    settings.tower_elements = 2 * run.ready.mesh.tower_elements;
    WindOperationOptions in_wind = run.in_wind;
    in_wind.progress = {};
    WindOperation operation(run.machine.description, assembly_options(run.machine, settings, run.options.gravity),
                            run.air.blade, in_wind);
    WindPoint point = operation.at(at);
    return {std::move(operation), std::move(point)};
}

AeroelasticOptions aeroelastic_options(const VibrationSettings& settings, const Aerodynamics& air) {
    AeroelasticOptions options;
    // Without induced velocities none can lag.
    if (air.options.induction) options.wake = settings.wake;
    if (settings.unsteady_airfoils) options.profiles = air.unsteady_airfoils;
    return options;
}

std::string in_words(const AeroelasticOptions& options, const Aerodynamics& air) {
    return air_in_words(air.options.induction ? name_of(options.wake) : "none", !options.profiles.empty());
}

}  // namespace cardan::turbines
