#include "turbines/analysis/wind_run.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/analysis/detail/rounded.hpp"
#include "turbines/analysis/machine_wind.hpp"
#include "turbines/analysis/rising.hpp"

#include <algorithm>
#include <utility>

namespace cardan::turbines {

namespace {

void take(const Report& report, const std::string& words) {
    report_remark(report, {Remark::Kind::taken, words});
}

std::string in_words(const VariableSpeed& law, const std::string& source) {
    const std::string pitch =
        law.min_pitch.empty() ? rounded(law.fine_pitch * units::to_degrees) + " deg" : "at least as scheduled";
    return text("operation: tip-speed ratio ", digits(law.tip_speed_ratio, std::chars_format::fixed, 3), ", ",
                rounded(law.min_rotor_speed * units::to_rpm), " to ", rounded(law.rated_speed * units::to_rpm),
                " rpm, pitch ", pitch, "; ", rounded(law.rated_power / 1e3), " kW on the rotor from rated wind on",
                source.empty() ? "" : text(" (", source, ")"));
}

bool sets_law(const OperationSettings& own) {
    return own.tip_speed_ratio || own.rated_power || own.rated_rotor_speed || own.min_rotor_speed;
}

// In another unit it is more than there is in any wind that blades turn in.
void require_power(double rated_power, const TurbineDescription& d) {
    constexpr double wind = 50, density = 1.225, betz = 16.0 / 27;  // m/s, kg/m^3
    const double radius = d.hub.radius + d.blade.line.length,
                 max = betz * density / 2 * pi * radius * radius * wind * wind * wind;
    if (rated_power > max)
        throw InputError(
            "OperationSettings::rated_power", "value [kW]", rounded(rated_power / 1e3),
            text("at most ", rounded(max / 1e3), ", all that the rotor can take from a wind of ", wind, " m/s"));
}

// What the settings say, else the controller of the machine.
VariableSpeed law_of(const Machine& machine, const WindRunOptions& options, const Aerodynamics& air, bool own_pitch) {
    const OperationSettings& own = options.operation;
    const TurbineDescription& d = machine.description;
    VariableSpeed law = variable_speed(machine.operation);
    if (own.rated_rotor_speed) law.rated_speed = *own.rated_rotor_speed;
    if (own.min_rotor_speed) law.min_rotor_speed = *own.min_rotor_speed;
    if (own.rated_power) law.rated_power = *own.rated_power;
    law.fine_pitch = options.machine.pitch.value_or(0);
    if (!own_pitch) law.min_pitch.clear();
    if (law.rated_power == 0)
        throw InputError("OperationSettings::rated_power", "value", "none, and the model names none",
                         "power of the air on the rotor at rated wind; or MachineOperation::schedule");
    require_power(law.rated_power, d);
    if (own.tip_speed_ratio)
        law.tip_speed_ratio = *own.tip_speed_ratio;
    else if (law.tip_speed_ratio == 0)
        law.tip_speed_ratio = best_tip_speed_ratio(air.blade, d.blades, d.blade.cone, law.fine_pitch, air.options);
    if (!(law.rated_speed > 0))
        throw InputError("OperationSettings::rated_rotor_speed", "value", "none, and the model names none",
                         "speed of the rotor from rated wind on; or MachineOperation::schedule");
    if (law.min_rotor_speed > law.rated_speed)
        throw InputError(own.min_rotor_speed ? "OperationSettings::min_rotor_speed" : machine.operation.source,
                         "minimum rotor speed [rpm]", rounded(law.min_rotor_speed * units::to_rpm),
                         text("at most ", rounded(law.rated_speed * units::to_rpm), ", the rated one",
                              own.min_rotor_speed ? "" : "; OperationSettings::min_rotor_speed gives another"));
    law.check();
    take(options.report, in_words(law, machine.operation.source));
    return law;
}

std::vector<Operation> scheduled(const Machine& machine, const WindRunOptions& options) {
    const std::vector<Operation>& schedule = machine.operation.schedule;
    take(options.report, text("operation: as scheduled over the wind, ", rounded(schedule.front().wind), " to ",
                              rounded(schedule.back().wind), " m/s"));
    std::vector<Operation> wanted;
    wanted.reserve(options.winds.size());
    for (const double wind : options.winds) wanted.push_back(operation_at(schedule, wind));
    return wanted;
}

WindOperationOptions operation_options(const Machine& machine, const WindRunOptions& o, const Aerodynamics& air,
                                       const Turbine& turbine) {
    WindOperationOptions in_wind;
    in_wind.wind = wind_profile(turbine, machine, o.air, air.density);
    in_wind.air = air.options;
    in_wind.support = support_on(turbine, machine, air.support);
    in_wind.airfoils = air.unsteady_airfoils;
    in_wind.harmonics = o.harmonics;
    in_wind.azimuths = o.azimuths;
    in_wind.cancelled = o.cancelled;
    return in_wind;
}

}  // namespace

WindRun wind_run(const Machine& source, const WindRunOptions& options) {
    WindRunOptions o = options;
    o.winds = rising(std::move(o.winds), "WindRunOptions::winds", "wind speeds", 1, "m/s", o.report);
    Machine machine = with_settings(source, o.machine, o.report);
    Aerodynamics air = air_of(machine, o.air);
    const bool own_pitch = !o.machine.pitch;
    if (own_pitch && machine.operation.min_pitch.empty())
        o.machine.pitch = pitch_at_speed({}, machine, machine.operation.rotor_speed, o.report);
    const bool by_law = machine.operation.schedule.empty() || sets_law(o.operation);
    std::optional<VariableSpeed> law;
    if (by_law) law = law_of(machine, o, air, own_pitch);
    std::vector<Operation> wanted = by_law ? std::vector<Operation>() : scheduled(machine, o);
    const AssemblyOptions assembly = assembly_options(machine, o.machine, o.gravity);
    PreparedTurbine ready = assembled(machine, assembly, o.max_frequency_hz, machine.operation.rotor_speed, o.report);
    keep_elements(ready.mesh, o.machine);
    WindOperationOptions in_wind = operation_options(machine, o, air, ready.turbine);
    WindOperation operation(machine.description, assembly_options(machine, o.machine, o.gravity), air.blade, in_wind);
    take(o.report, text("air of the operating points: ", air_in_equilibrium(air)));
    return {.machine = std::move(machine),
            .options = std::move(o),
            .own_pitch = own_pitch,
            .air = std::move(air),
            .ready = std::move(ready),
            .in_wind = std::move(in_wind),
            .operation = std::move(operation),
            .law = std::move(law),
            .scheduled = std::move(wanted)};
}

const WindOperatingPoint* next_point(WindRun& run) {
    const WindRunOptions& o = run.options;
    const auto cancelled = [&] { return o.cancelled && o.cancelled(); };
    while (run.tried < o.winds.size() && !cancelled()) {
        const std::size_t i = run.tried;
        WindOperatingPoint point =
            run.law ? run.operation.at(o.winds[i], *run.law) : run.operation.at(run.scheduled[i]);
        if (!point.converged && cancelled()) break;
        run.complete = ++run.tried == o.winds.size();
        if (point.converged) {
            run.truncation_residual = std::max(run.truncation_residual, point.remainder);
            return &run.points.emplace_back(std::move(point));
        }
        report_remark(o.report, {Remark::Kind::warning, text("not converged: ", point.message)});
        run.not_converged.push_back(point.operation.wind);
    }
    return nullptr;
}

void find_points(WindRun& run) {
    const WindRunOptions& o = run.options;
    const auto total = static_cast<int>(o.winds.size());
    if (o.progress) o.progress(0, total);
    while (next_point(run) != nullptr)
        if (o.progress) o.progress(static_cast<int>(run.tried), total);
}

FinerPoint finer_point(const WindRun& run, const Operation& at) {
    MachineSettings settings = run.options.machine;
    settings.blade_elements = 2 * run.ready.mesh.blade_elements;
    settings.tower_elements = 2 * run.ready.mesh.tower_elements;
    WindOperation operation(run.machine.description, assembly_options(run.machine, settings, run.options.gravity),
                            run.air.blade, run.in_wind);
    WindOperatingPoint point = operation.at(at);
    return {std::move(operation), std::move(point)};
}

AeroelasticOptions aeroelastic_options(const Aerodynamics& air) {
    return {.wake = air.model.wake,
            .inflow_time_constant = air.model.inflow_time_constant,
            .airfoils = air.unsteady_airfoils};
}

}  // namespace cardan::turbines
