// Operating points of a machine over the wind speed: blade-element momentum on the bent, turning blades.
//
// Problem: at every wind speed the rotor turns at the speed, with the pitch, that a schedule gives, or that a machine
// of variable speed chooses: best tip-speed ratio at the fine pitch, beyond rated power rated speed and the pitch that
// holds it. The rotor is in its steady state, deformed, periodic where gravity, tilt or the wind make it so.
// Checked: what the neglected harmonics would have to balance is printed; what does not converge is named.
#include "examples/programs/cardan/steady_wind.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/machines/nrel5mw_air.hpp"
#include "turbines/operation/wind_operation.hpp"
#include "turbines/readers/aerodyn.hpp"
#include "turbines/readers/csv.hpp"
#include "turbines/readers/openfast_file.hpp"
#include "turbines/yaml/windio_air.hpp"

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

// Profiles and options of the air, and what a machine that is built in does in the wind.
struct Air {
    AeroBlade blade;
    RotorAirOptions options;
    double density = 1.225;
    double rated_power = 0, least_speed = 0;  // W, rad/s; 0: not known
};

// As AeroDyn's or windIO's reader gives them.
template <class File>
void take(Air& air, File read, const MachineOptions& options) {
    print_notes(read.notes, options.notes);
    air.blade = std::move(read.blade);
    air.options = read.options;
    air.density = read.density;
}

// What an AeroDyn file calls "default" is in the main file of OpenFAST.
turbines::AeroDynFile aerodyn_of(const MachineFile& machine, const MachineOptions& options,
                                 std::filesystem::path file) {
    const double hub_radius = machine.file.description.hub.radius;
    if (machine.kind != MachineKind::openfast) return turbines::read_aerodyn(file, hub_radius);
    turbines::OpenFastFile main = turbines::OpenFastFile::read(options.model);
    if (file.empty()) file = main.path("AeroFile");
    return turbines::read_aerodyn(file, hub_radius, main.number_or_default("AirDens", 1.225),
                                  main.number_or_default("KinVisc", standard_viscosity));
}

bool has_aerodyn(const MachineFile& machine, const MachineOptions& options) {
    return machine.kind == MachineKind::openfast && turbines::OpenFastFile::read(options.model).has("AeroFile");
}

Air air_of(const MachineFile& machine, const MachineOptions& options, const WindArguments& wind) {
    const double hub_radius = machine.file.description.hub.radius;
    Air air;
    if (is_yaml(wind.air)) {
        take(air, turbines::read_windio_air(wind.air, hub_radius), options);
    } else if (!wind.air.empty() || has_aerodyn(machine, options)) {
        take(air, aerodyn_of(machine, options, wind.air), options);
    } else if (machine.kind == MachineKind::windio) {
        take(air, turbines::read_windio_air(options.model, hub_radius, additions_of(options)), options);
    } else if (options.model.starts_with("nrel5mw")) {
        air.blade = turbines::nrel5mw_aero_blade();
        air.rated_power = 5e6 / 0.944;  // with the losses of the generator, Table 5-1
        air.least_speed = 6.9 * units::rpm;
    } else {
        throw InputError("--air", "value", "none, and the machine has no profiles",
                         "FILE, the main file of AeroDyn, or windIO");
    }
    if (wind.no_skew) air.options.skew = Skew::none;
    if (wind.density) air.density = *wind.density;
    return air;
}

turbines::VariableSpeed law_of(const MachineFile& machine, const MachineOptions& options, const WindArguments& wind,
                               const Air& air) {
    const turbines::TurbineDescription& d = machine.file.description;
    turbines::VariableSpeed law;
    law.rated_speed = wind.rated_rpm ? *wind.rated_rpm * units::rpm : machine.file.rotor_speed;
    law.least_speed = wind.least_rpm > 0 ? wind.least_rpm * units::rpm : air.least_speed;
    law.rated_power = wind.rated_power ? *wind.rated_power * 1e3 : air.rated_power;
    law.fine_pitch = options.pitch.value_or(0) * units::degree;
    law.tip_speed_ratio = wind.tip_speed_ratio ? *wind.tip_speed_ratio
                                               : turbines::best_tip_speed_ratio(air.blade, d.blades, d.blade.cone,
                                                                                law.fine_pitch, air.options);
    if (law.rated_power == 0)
        throw InputError("--rated-power", "value", "none",
                         "power of the air on the rotor at rated wind, kW; or a --schedule");
    std::printf("operation: tip-speed ratio %.3f, %g to %g rpm, pitch %g deg; %g kW on the rotor from rated wind on\n",
                law.tip_speed_ratio, law.least_speed * units::to_rpm, law.rated_speed * units::to_rpm,
                law.fine_pitch * units::to_degrees, law.rated_power / 1e3);
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
    app.add_option("--air", a.air, "profiles: the main file of AeroDyn 15, or windIO (default: those of the model)")
        .type_name("FILE");
    app.add_option(
           "--schedule", a.schedule,
           "how the machine runs: CSV with the columns wind[m/s],rotor_speed[rpm],pitch[deg] (default: variable "
           "speed with the following options)")
        .type_name("FILE");
    app.add_option("--rated-power", a.rated_power, "of the air on the rotor, kW (default: a built-in machine's)");
    app.add_option("--rated-rpm", a.rated_rpm, "rotor speed from rated wind on, rev/min (default: the machine's)");
    app.add_option("--least-rpm", a.least_rpm, "rotor speed at least, rev/min");
    app.add_option("--tip-speed-ratio", a.tip_speed_ratio,
                   "below rated power (default: that of the largest power coefficient at --pitch)");
    app.add_option("--shear", a.shear, "exponent of the wind's profile over the height");
    app.add_option("--wind-direction", a.direction, "where the wind blows to, deg from downwind to the left");
    app.add_option("--upflow", a.upflow, "of the wind, deg");
    app.add_option("--density", a.density, "of the air, kg/m^3 (default: that of the profiles' file, 1.225)");
    app.add_flag("--no-skew", a.no_skew, "without redistribution of the induction in a skewed wake");
}

int steady_in_wind(const MachineFile& machine, MachineOptions& options, const WindArguments& wind, int harmonics,
                   int azimuths, const std::string& prefix, const CommandLine& command) {
    const turbines::TurbineDescription& d = machine.file.description;
    const std::vector<double> speeds = numbers_in_ranges("--wind", wind.speeds, wind_format);
    const Air air = air_of(machine, options, wind);
    if (!options.pitch) set_pitch(machine, options, machine.file.rotor_speed);
    const ReadyMachine ready =
        ready_machine(machine, options, usual_frequency(machine, options), machine.file.rotor_speed);
    check_outputs(prefix, {".h5", ".csv", ".svg", ".png"});

    turbines::WindOperationOptions in_wind;
    const Vec3 hub = turbines::hub_at_rest(ready.turbine);
    in_wind.wind = {.reference_height = hub.z(),
                    .shear = wind.shear == 0 ? Shear::none : Shear::power,
                    .exponent = wind.shear,
                    .direction = wind.direction * units::degree,
                    .upflow = wind.upflow * units::degree,
                    .density = air.density};
    in_wind.air = air.options;
    in_wind.harmonics = harmonics;
    in_wind.azimuths = azimuths;
    std::size_t done = 0;
    in_wind.progress = [&](const WindPoint&) {
        ++done;
        progress(text("\rwind speed ", done, " of ", speeds.size(), done == speeds.size() ? "\n" : ""));
        return !interrupted();
    };
    turbines::WindOperation operation(d, assembly_options(machine, options), air.blade, in_wind);
    std::vector<WindPoint> all;
    if (wind.schedule.empty()) {
        all = operation.over(speeds, law_of(machine, options, wind, air));
    } else {
        const std::vector<turbines::Operation> schedule = schedule_of(wind.schedule);
        std::vector<turbines::Operation> wanted;
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
    const WindResults results = wind_results(operation, std::move(points), text(d.name, ", in the wind"));
    std::printf("\n%s\n%s\n", results.title.c_str(), in_words(ready.mesh).c_str());
    if (!operation.is_constant())
        std::printf(
            "%d harmonics of the revolution; what those left out would have to balance, over stiffness: up to "
            "%.1e rad or m\n",
            harmonics, remainder);
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
