#include "programs/cardan/options.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/program.hpp"
#include "programs/shared/remarks.hpp"
#include "programs/shared/words.hpp"
#include "turbines/analysis/in_unit.hpp"
#include "turbines/analysis/rising.hpp"
#include "turbines/machine/read_machine.hpp"

#include <cmath>
#include <filesystem>

namespace cardan::program {

namespace {

constexpr auto wind_format = "numbers and FIRST:LAST:STEP separated by commas, m/s";

}  // namespace

std::vector<Option> add_airfoil_options(CommandLine& app, AirArguments& a) {
    return {app.add_option("--air", a.file,
                           "airfoils: the main file of AeroDyn 15, or windIO (default: those of the model)")
                .type_name("FILE"),
            app.add_option("--density", a.density, "of the air, kg/m^3 (default: that of the airfoils' file, 1.225)")
                .positive()};
}

std::vector<Option> add_air_options(CommandLine& app, AirArguments& a) {
    std::vector<Option> all = add_airfoil_options(app, a);
    all.push_back(app.add_option("--shear", a.shear, "exponent of the wind's profile over the height").finite());
    all.push_back(
        app.add_option("--wind-direction", a.direction, "where the wind blows to, deg from downwind to the left")
            .finite());
    all.push_back(app.add_option("--upflow", a.upflow, "of the wind, deg").finite());
    all.push_back(app.add_flag("--no-tower", a.no_tower,
                               "without the tower's influence on the wind, and the air's drag on tower and nacelle"));
    all.push_back(app.add_flag("--no-skew", a.no_skew, "without redistribution of the induction in a skewed wake"));
    all.push_back(app.add_option("--wake", a.wake,
                                 "induced velocities: none; frozen at the means of a steady rotation; in equilibrium "
                                 "with the loads of the instant; or lagging behind them, oye (default: as the model "
                                 "says, else oye)")
                      .one_of({"none", "frozen", "equilibrium", "oye"}));
    all.push_back(add_airfoils_option(app, a));
    return all;
}

Option add_airfoils_option(CommandLine& app, AirArguments& a) {
    return app
        .add_option("--airfoils", a.airfoils,
                    "steady: lift, drag and moment follow the angle of attack at once; unsteady: they lag, where the "
                    "airfoils have data of that (default: as the model says, else unsteady)")
        .one_of({"steady", "unsteady"});
}

turbines::AirSettings settings_of(const AirArguments& a) {
    turbines::AirSettings settings{.shear_exponent = a.shear,
                                   .propagation_direction = a.direction * units::degree,
                                   .upflow = a.upflow * units::degree,
                                   .density = a.density,
                                   .skewed_wake = !a.no_skew,
                                   .tower_nacelle = !a.no_tower};
    if (!a.wake.empty()) settings.wake = wake_named(a.wake, "--wake");
    if (!a.airfoils.empty()) settings.airfoils = airfoils_named(a.airfoils, "--airfoils");
    return settings;
}

void take_air(turbines::Machine& machine, const AirArguments& arguments, MachineOptions& options) {
    if (!arguments.file.empty()) machine.air = turbines::read_air(arguments.file, machine);
    if (!machine.air)
        throw InputError("--air", "value", text("none, and ", machine.no_air),
                         "FILE, the main file of AeroDyn, or windIO");
    machine.no_air.clear();
    print_notes(machine.air->notes, options, "notes on the air");
}

IecClass wind_class_of(const std::string& name) {
    if (name.empty()) return {};
    try {
        return iec_class(name);
    } catch (const InputError& error) {
        throw InputError(text("--wind-class: ", error.what()));
    }
}

turbines::WindSource wind_source(const std::string& given) {
    if (given == "none") return turbines::WindSource::none();
    // A number or a name is what it says, whatever files there are of that name: ./12 is one.
    if (read_number(given).good()) {
        const double speed = number("--wind", given, given, wind_file_format);
        require_not_negative("--wind", "value [m/s]", speed);
        return speed;
    }
    if (!given.empty() && std::isalpha(static_cast<unsigned char>(given.front())) != 0 &&
        (given.find(':') != std::string::npos || lower_case(given).starts_with("ewm"))) {
        try {
            return iec_wind_name(given);
        } catch (const InputError& error) {
            throw InputError(text("--wind: ", error.what()));
        }
    }
    if (std::error_code none; std::filesystem::exists(given, none)) return std::filesystem::path(given);
    const double speed = number("--wind", given, given, wind_file_format);
    require_not_negative("--wind", "value [m/s]", speed);
    return speed;
}

Option add_wind_options(CommandLine& app, WindArguments& a) {
    Option wind = app.add_option("--wind", a.speeds, std::string("wind speeds at the hub's height, ") + wind_format);
    std::vector<Option> beside = add_air_options(app, a.air);
    beside.push_back(
        app.add_option("--schedule", a.schedule,
                       "how the machine runs: CSV with the columns wind[m/s],rotor_speed[rpm],pitch[deg] (default: the "
                       "machine's, if it has one; else variable speed with the following options)")
            .type_name("FILE"));
    beside.push_back(app.add_option("--rated-power", a.rated_power,
                                    "of the air on the rotor, kW (default: the machine's controller's)")
                         .positive());
    beside.push_back(
        app.add_option("--rated-rpm", a.rated_rpm, "rotor speed from rated wind on, rev/min (default: the machine's)")
            .positive());
    beside.push_back(app.add_option("--min-rpm", a.min_rpm,
                                    "minimum rotor speed, rev/min (default: that of the machine's controller)")
                         .not_negative());
    beside.push_back(
        app.add_option("--tip-speed-ratio", a.tip_speed_ratio,
                       "below rated power (default: that of the machine's controller, or of the largest power "
                       "coefficient)")
            .positive());
    for (Option& option : beside) option.only_with(wind);
    return wind;
}

bool WindArguments::sets_law() const {
    return tip_speed_ratio || rated_power || rated_rpm || min_rpm > 0;
}

void check_wind(const WindArguments& wind, const std::string& rpm) {
    if (wind.speeds.empty()) return;
    if (!rpm.empty()) throw InputError("--rpm", "value", rpm, "none beside --wind: see --schedule");
    if (!wind.schedule.empty() && wind.sets_law())
        throw InputError("--schedule", "file", wind.schedule,
                         "none beside --rated-power, --rated-rpm, --min-rpm, --tip-speed-ratio");
}

void take_wind(turbines::Machine& machine, const WindArguments& wind, MachineOptions& options) {
    take_air(machine, wind.air, options);
    if (wind.schedule.empty()) return;
    machine.operation.schedule = turbines::read_schedule(wind.schedule);
}

std::vector<double> winds_of(const WindArguments& wind) {
    if (wind.speeds.empty()) return {};
    return turbines::rising(numbers_in_ranges("--wind", wind.speeds, wind_format), "--wind", "wind speeds", 1, "m/s",
                            print_remark);
}

turbines::OperationSettings operation_of(const WindArguments& wind) {
    turbines::OperationSettings own;
    if (wind.rated_power) own.rated_power = *wind.rated_power * 1e3;
    if (wind.rated_rpm) own.rated_rotor_speed = *wind.rated_rpm * units::rpm;
    if (wind.min_rpm > 0) own.min_rotor_speed = wind.min_rpm * units::rpm;
    own.tip_speed_ratio = wind.tip_speed_ratio;
    return own;
}

Option add_vibration_options(CommandLine& app, VibrationArguments& a) {
    const Option wind = add_wind_options(app, a.wind);
    app.add_option("--harmonics", a.harmonics, "harmonics of the revolution that are balanced, with --wind")
        .range(1, 200)
        .only_with(wind);
    return wind;
}

void show_progress(const char* what, int done, int total) {
    if (done == 1) keep_from_here();
    progress(text(what, " ", done, " of ", total, done == total ? "\n" : ""));
}

std::optional<double> asked_speed(const std::optional<double>& asked_rpm) {
    if (!asked_rpm) return std::nullopt;
    if (!std::isfinite(*asked_rpm)) throw InputError("--rpm", "value", *asked_rpm, "finite");
    return *asked_rpm * units::rpm;
}

double rotor_speed(const std::optional<double>& asked_rpm, const turbines::Machine& machine) {
    return turbines::rotor_speed_of(asked_speed(asked_rpm), machine, "--rpm", remarks_printed(false));
}

void set_pitch(const turbines::Machine& machine, MachineOptions& options, double rotor_speed) {
    if (options.pitch) return;
    const double pitch = turbines::pitch_at_speed({}, machine, rotor_speed, remarks_printed(false));
    options.pitch = turbines::in_unit(pitch, units::degree);
}

void add_like(CommandLine& app, std::string& file) {
    app.add_option("--like", file,
                   "result (.h5) of campbell or modes for a similar machine: modes have the names of those there that "
                   "they are most like, at the rotor speeds that both have")
        .type_name("BASE.h5");
}

std::string title_of(const solvers::Campbell& diagram) {
    return diagram.remark.empty() ? diagram.machine : text(diagram.machine, ", ", diagram.remark);
}

std::string default_prefix(const std::string& machine, const char* what) {
    return std::filesystem::path(machine).stem().string() + "_" + what;
}

}  // namespace cardan::program
