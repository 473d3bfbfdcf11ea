// Operating points of a machine over the wind speed: blade-element momentum on the bent, turning blades.
//
// Problem: at every wind speed the rotor turns at the speed, with the pitch, that a schedule gives, or that a machine
// of variable speed chooses: best tip-speed ratio at the fine pitch, beyond rated power rated speed and the pitch that
// holds it. The rotor is in its steady state, deformed, periodic where gravity, tilt or the wind make it so.
// Checked: what the neglected harmonics would have to balance is printed; what does not converge is named.
#include "examples/programs/cardan/steady_wind.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/operation/wind_operation.hpp"
#include "turbines/readers/csv.hpp"

#include "examples/programs/cardan/operation.hpp"
#include "examples/programs/cardan/wind_results.hpp"
#include "examples/shared/program.hpp"
#include "examples/shared/words.hpp"
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
        law.least_pitch.empty() ? in_digits(law.fine_pitch * units::to_degrees) + " deg" : "at least as scheduled";
    std::printf("operation: tip-speed ratio %.3f, %g to %g rpm, pitch %s; %g kW on the rotor from rated wind on%s\n",
                law.tip_speed_ratio, law.least_speed * units::to_rpm, law.rated_speed * units::to_rpm, pitch.c_str(),
                law.rated_power / 1e3, source.empty() ? "" : (" (" + source + ")").c_str());
}

// What the options say, else the controller of the machine.
// @param pitch  of the options, deg
turbines::VariableSpeed law_of(const MachineFile& machine, const std::optional<double>& pitch,
                               const MachineOptions& options, const WindArguments& wind, const Air& air) {
    const turbines::TurbineDescription& d = machine.file.description;
    const turbines::FileOperation& own = machine.file.operation;
    turbines::VariableSpeed law;
    law.rated_speed = wind.rated_rpm ? *wind.rated_rpm * units::rpm : machine.file.rotor_speed;
    law.least_speed = wind.least_rpm > 0 ? wind.least_rpm * units::rpm : own.least_speed;
    law.rated_power = wind.rated_power ? *wind.rated_power * 1e3 : own.rated_power;
    law.fine_pitch = options.pitch.value_or(0) * units::degree;
    if (!pitch) law.least_pitch = own.least_pitch;
    if (wind.tip_speed_ratio)
        law.tip_speed_ratio = *wind.tip_speed_ratio;
    else if (own.tip_speed_ratio > 0)
        law.tip_speed_ratio = own.tip_speed_ratio;
    else
        law.tip_speed_ratio =
            turbines::best_tip_speed_ratio(air.blade, d.blades, d.blade.cone, law.fine_pitch, air.options);
    if (law.rated_power == 0)
        throw InputError("--rated-power", "value", "none",
                         "power of the air on the rotor at rated wind, kW; or a --schedule");
    print(law, own.source);
    return law;
}

std::vector<turbines::Operation> schedule_of(const std::string& path) {
    const turbines::CsvTable table = turbines::CsvTable::read(path);
    const auto wind = table.column("wind", "m/s"), speed = table.column("rotor_speed", "rpm"),
               pitch = table.column("pitch", "deg");
    std::vector<turbines::Operation> schedule;
    for (std::size_t i = 0; i < table.rows(); ++i)
        schedule.push_back({wind[i], speed[i] * units::rpm, pitch[i] * units::degree});
    return schedule;
}

}  // namespace

void add_wind_options(CommandLine& app, WindArguments& a) {
    app.add_option("--wind", a.speeds, std::string("wind speeds at the hub's height, ") + wind_format);
    app.add_option(
           "--schedule", a.schedule,
           "how the machine runs: CSV with the columns wind[m/s],rotor_speed[rpm],pitch[deg] (default: variable "
           "speed with the following options)")
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

int steady_in_wind(const MachineFile& machine, MachineOptions& options, const WindArguments& wind,
                   const RevolutionOptions& revolution, const std::string& prefix, const CommandLine& command) {
    const turbines::TurbineDescription& d = machine.file.description;
    const std::vector<double> speeds = numbers_in_ranges("--wind", wind.speeds, wind_format);
    const Air air = air_of(machine, options, wind.air);
    const std::optional<double> pitch = options.pitch;
    if (!options.pitch && machine.file.operation.least_pitch.empty())
        set_pitch(machine, options, machine.file.rotor_speed);
    const ReadyMachine ready =
        ready_machine(machine, options, usual_frequency(machine, options), machine.file.rotor_speed);
    check_outputs(prefix, {".h5", ".csv", ".svg", ".png"});

    turbines::WindOperationOptions in_wind;
    in_wind.wind = wind_profile(wind.air, air, machine, ready.turbine);
    in_wind.air = air.options;
    in_wind.support = support_of(air, machine, ready.turbine);
    in_wind.harmonics = revolution.harmonics;
    in_wind.azimuths = revolution.azimuths;
    std::size_t done = 0;
    in_wind.progress = [&](const WindPoint&) {
        ++done;
        progress(text("\rwind speed ", done, " of ", speeds.size(), done == speeds.size() ? "\n" : ""));
        return !interrupted();
    };
    turbines::WindOperation operation(d, assembly_options(machine, options), air.blade, in_wind);
    std::vector<WindPoint> all;
    if (wind.schedule.empty()) {
        all = operation.over(speeds, law_of(machine, pitch, options, wind, air));
    } else {
        const std::vector<turbines::Operation> schedule = schedule_of(wind.schedule);
        std::vector<turbines::Operation> wanted;
        wanted.reserve(speeds.size());
        for (const double speed : speeds) wanted.push_back(turbines::operation_at(schedule, speed));
        all = operation.over(wanted);
    }
    const bool complete = all.size() == speeds.size() && !interrupted();
    stop_at_once();
    std::vector<WindPoint> points;
    double remainder = 0;
    for (WindPoint& point : all) {
        if (!point.converged) {
            std::cerr << "warning: not converged: " << point.message << "\n";
            continue;
        }
        remainder = std::max(remainder, point.remainder);
        points.push_back(std::move(point));
    }
    if (points.empty()) return complete ? 1 : 130;
    const WindResults results =
        wind_results(operation, std::move(points), revolution.stations, text(d.name, ", in the wind"));
    std::printf("\n%s\n%s\n", results.title.c_str(), in_words(ready.mesh).c_str());
    if (!operation.is_constant())
        std::printf(
            "%d harmonics of the revolution; what those left out would have to balance, over stiffness: up to "
            "%.1e rad or m\n",
            revolution.harmonics, remainder);
    print(results);
    write_csv(results, prefix);
    write_hdf5(results, prefix + ".h5", run_text("steady", command) + ready.turbine.rotor().description);
    std::printf("\nfiles: %s.h5, .csv, _sections.csv", prefix.c_str());
    if (results.points.size() > 1) {
        draw_points(results, prefix);
        std::printf(", .svg, .png");
    }
    draw_sections(results, prefix);
    draw_coefficients(results.title, air.blade, air.options, d.blades, d.blade.cone, prefix);
    std::printf(", _sections.svg, .png, _coefficients.svg, .png\n");
    if (!complete) return 130;
    return results.points.size() == all.size() ? 0 : 1;
}

}  // namespace cardan::program
