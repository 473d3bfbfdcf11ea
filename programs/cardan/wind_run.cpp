#include "programs/cardan/wind_run.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/machine/read_machine.hpp"

#include "programs/cardan/operation.hpp"
#include "programs/shared/program.hpp"
#include "programs/shared/words.hpp"
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <utility>

namespace cardan::program {

namespace {

using turbines::WindPoint;
constexpr auto wind_format = "numbers and FIRST:LAST:STEP separated by commas, m/s";

void print(const turbines::VariableSpeed& law, const std::string& source) {
    const std::string pitch =
        law.least_pitch.empty() ? digits(law.fine_pitch * units::to_degrees) + " deg" : "at least as scheduled";
    std::printf("operation: tip-speed ratio %.3f, %g to %g rpm, pitch %s; %g kW on the rotor from rated wind on%s\n",
                law.tip_speed_ratio, law.least_speed * units::to_rpm, law.rated_speed * units::to_rpm, pitch.c_str(),
                law.rated_power / 1e3, source.empty() ? "" : (" (" + source + ")").c_str());
}

// What the options say, else the controller of the machine.
// @param pitch  of the options, deg
turbines::VariableSpeed law_of(const turbines::Machine& machine, const std::optional<double>& pitch,
                               const MachineOptions& options, const WindArguments& wind,
                               const turbines::Aerodynamics& air) {
    const turbines::TurbineDescription& d = machine.description;
    turbines::VariableSpeed law = turbines::variable_speed(machine.operation);
    if (wind.rated_rpm) law.rated_speed = *wind.rated_rpm * units::rpm;
    if (wind.least_rpm > 0) law.least_speed = wind.least_rpm * units::rpm;
    if (wind.rated_power) law.rated_power = *wind.rated_power * 1e3;
    law.fine_pitch = options.pitch.value_or(0) * units::degree;
    if (pitch) law.least_pitch.clear();
    if (wind.tip_speed_ratio)
        law.tip_speed_ratio = *wind.tip_speed_ratio;
    else if (law.tip_speed_ratio == 0)
        law.tip_speed_ratio =
            turbines::best_tip_speed_ratio(air.blade, d.blades, d.blade.cone, law.fine_pitch, air.options);
    if (law.rated_power == 0)
        throw InputError("--rated-power", "value", "none",
                         "power of the air on the rotor at rated wind, kW; or a --schedule");
    print(law, machine.operation.source);
    return law;
}

// By variable speed as the options say it, or for want of a schedule.
bool follows_law(const turbines::Machine& machine, const WindArguments& wind) {
    return machine.operation.schedule.empty() || wind.sets_law();
}

turbines::WindOperationOptions options_of(const turbines::Machine& machine, const WindArguments& wind,
                                          const turbines::Aerodynamics& air, const turbines::Turbine& turbine,
                                          int harmonics, int azimuths, std::size_t speeds) {
    turbines::WindOperationOptions in_wind;
    in_wind.wind = wind_profile(wind.air, air.density, machine, turbine);
    in_wind.air = air.options;
    in_wind.support = turbines::support_on(turbine, machine, air.support);
    in_wind.harmonics = harmonics;
    in_wind.azimuths = azimuths;
    in_wind.progress = [speeds, done = std::size_t{0}](const WindPoint&) mutable {
        ++done;
        progress(text("\rwind speed ", done, " of ", speeds, done == speeds ? "\n" : ""));
        return !interrupted();
    };
    return in_wind;
}

}  // namespace

void add_wind_options(CommandLine& app, WindArguments& a) {
    app.add_option("--wind", a.speeds, std::string("wind speeds at the hub's height, ") + wind_format);
    app.add_option("--schedule", a.schedule,
                   "how the machine runs: CSV with the columns wind[m/s],rotor_speed[rpm],pitch[deg] (default: the "
                   "machine's, if it has one; else variable speed with the following options)")
        .type_name("FILE");
    app.add_option("--rated-power", a.rated_power, "of the air on the rotor, kW (default: the machine's controller's)");
    app.add_option("--rated-rpm", a.rated_rpm, "rotor speed from rated wind on, rev/min (default: the machine's)");
    app.add_option("--least-rpm", a.least_rpm,
                   "rotor speed at least, rev/min (default: that of the machine's controller)");
    app.add_option(
        "--tip-speed-ratio", a.tip_speed_ratio,
        "below rated power (default: that of the machine's controller, or of the largest power coefficient)");
    add_air_options(app, a.air);
}

bool WindArguments::sets_law() const {
    return tip_speed_ratio || rated_power || rated_rpm || least_rpm > 0;
}

void take_wind(turbines::Machine& machine, const WindArguments& wind, bool all_notes) {
    take_air(machine, wind.air, all_notes);
    if (wind.schedule.empty()) return;
    if (wind.sets_law())
        throw InputError("--schedule", "file", wind.schedule,
                         "none beside --rated-power, --rated-rpm, --least-rpm, --tip-speed-ratio");
    machine.operation.schedule = turbines::read_schedule(wind.schedule);
}

WindRun wind_run(const turbines::Machine& machine, MachineOptions& options, const WindArguments& wind, int harmonics,
                 int azimuths, double max_frequency) {
    turbines::Aerodynamics air = air_of(machine, wind.air);
    std::vector<double> speeds = numbers_in_ranges("--wind", wind.speeds, wind_format);
    const std::optional<double> asked_pitch = options.pitch;
    if (!options.pitch && machine.operation.min_pitch.empty())
        set_pitch(machine, options, machine.operation.rotor_speed);
    ReadyMachine ready = ready_machine(machine, options, max_frequency, machine.operation.rotor_speed);
    turbines::WindOperationOptions in_wind =
        options_of(machine, wind, air, ready.turbine, harmonics, azimuths, speeds.size());
    turbines::WindOperation operation(machine.description, assembly_options(machine, options), air.blade, in_wind);
    return {.air = std::move(air),
            .speeds = std::move(speeds),
            .asked_pitch = asked_pitch,
            .ready = std::move(ready),
            .in_wind = std::move(in_wind),
            .operation = std::move(operation)};
}

FinerPoint finer_point(const WindRun& run, const turbines::Machine& machine, MachineOptions options,
                       const turbines::Operation& at) {
    options.blade_elements *= 2;
    options.tower_elements *= 2;
    turbines::WindOperationOptions in_wind = run.in_wind;
    in_wind.progress = {};
    turbines::WindOperation operation(machine.description, assembly_options(machine, options), run.air.blade, in_wind);
    WindPoint point = operation.at(at);
    return {std::move(operation), std::move(point)};
}

void find_points(WindRun& run, const turbines::Machine& machine, const MachineOptions& options,
                 const WindArguments& wind) {
    tell_air("operating points", air_in_equilibrium(run.air));
    std::vector<WindPoint> all;
    if (follows_law(machine, wind)) {
        all = run.operation.over(run.speeds, law_of(machine, run.asked_pitch, options, wind, run.air));
    } else {
        std::printf("operation: as scheduled over the wind, %g to %g m/s\n", machine.operation.schedule.front().wind,
                    machine.operation.schedule.back().wind);
        std::vector<turbines::Operation> wanted;
        wanted.reserve(run.speeds.size());
        for (const double speed : run.speeds)
            wanted.push_back(turbines::operation_at(machine.operation.schedule, speed));
        all = run.operation.over(wanted);
    }
    run.complete = all.size() == run.speeds.size() && !interrupted();
    stop_at_once();
    for (WindPoint& point : all) {
        if (!point.converged) {
            std::cerr << "warning: not converged: " << point.message << "\n";
            continue;
        }
        run.remainder = std::max(run.remainder, point.remainder);
        run.points.push_back(std::move(point));
    }
}

int WindRun::exit_code() const {
    if (!complete) return 130;
    return points.size() == speeds.size() ? 0 : 1;
}

}  // namespace cardan::program
