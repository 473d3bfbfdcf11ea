// Steady state of any machine: at one rotor speed without air, deflections and loads over a revolution; or in the wind,
// over the wind speed.
//
// Problem: the rotor turns at constant speed and everything else has the period of a revolution: gravity, two blades,
// blades that differ; the steady state is found by harmonic balance. At rest, or where nothing depends on the azimuth,
// it is constant. Without wind what is seen is what weights and rotation do.
// In the wind (blade-element momentum on the bent, turning blades) the rotor turns at every wind speed at the speed,
// with the pitch, that a schedule gives, or that a machine of variable speed chooses: best tip-speed ratio at the fine
// pitch, beyond rated power rated speed and the pitch that holds it. Checked: what the neglected harmonics would have
// to balance is printed; what does not converge is named.
#include "mbs/base/error.hpp"
#include "mbs/base/outcome.hpp"
#include "mbs/base/units.hpp"
#include "programs/cardan/commands.hpp"
#include "programs/cardan/options.hpp"
#include "programs/cardan/revolution.hpp"
#include "programs/cardan/wind_results.hpp"
#include "programs/shared/channel_choice.hpp"
#include "programs/shared/program.hpp"
#include "programs/shared/words.hpp"
#include "solvers/hdf5/history.hpp"
#include "solvers/pictures/history.hpp"
#include "turbines/analysis/in_unit.hpp"
#include "turbines/analysis/steady_rotation.hpp"
#include "turbines/machine/machine_text.hpp"
#include "turbines/model/channels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace cardan::program {

namespace {

struct SteadyArguments {
    MachineOptions machine;
    WindArguments wind;
    RevolutionOptions revolution;
    std::optional<double> rpm;
    double azimuth = 0;
    bool no_gravity = false, all = false;
    std::string out;
};

void declare(CommandLine& app, SteadyArguments& a) {
    add_machine(app, a.machine);
    app.add_option("--rpm", a.rpm, "rotor speed, rev/min (default: the machine's)").finite();
    app.add_option("--azimuth", a.azimuth, "azimuth of blade 1 at rest, deg, zero upward").finite();
    app.add_option("--azimuths", a.revolution.azimuths, "azimuths per revolution that are written").range(4, 100000);
    app.add_option("--harmonics", a.revolution.harmonics, "harmonics of the revolution that are balanced")
        .range(1, 200);
    app.add_flag("--no-gravity", a.no_gravity, "without gravity");
    app.add_flag("--all", a.all, "print all channels, not only the main ones");
    add_station_options(app, a.revolution.stations);
    add_wind_options(app, a.wind);
    add_machine_options(app, a.machine);
    app.add_option("--out", a.out, "prefix of the files (default: the machine's name and _steady)");
}

// One revolution; at rest one state.
struct Revolution {
    std::vector<DynamicState> states;
    std::string about;
};

Revolution revolution(const turbines::Turbine& turbine, double speed, const SteadyArguments& a) {
    if (speed == 0) return {{turbines::standstill(turbine, a.azimuth * units::degree)}, "at rest"};
    const solvers::PeriodicSteadyState state = turbines::steady_rotation(
        turbine, speed, {.harmonics = a.revolution.harmonics, .cancelled = interrupted}, remarks_printed(false));
    Revolution all;
    const double turn = std::copysign(2 * pi, speed);  // in the order of time
    for (int i = 0; i < a.revolution.azimuths; ++i) all.states.push_back(state.at(turn * i / a.revolution.azimuths));
    std::array<char, 16> remainder{};
    std::snprintf(remainder.data(), remainder.size(), "%.1e", state.remainder);
    all.about =
        text(state.harmonics(),
             " harmonics; what those left out would have to balance, over stiffness: ", remainder.data(), " rad or m");
    return all;
}

void print(const solvers::History& history, const std::vector<std::string>& names) {
    std::printf("\n%-40s %14s %14s %14s\n", "over a revolution", "mean", "minimum", "maximum");
    for (const std::string& name : names) {
        const std::size_t i = history.index(name);
        const auto [mean, min, max] = mean_and_range(history.values[i]);
        std::printf("%-40s %14.6g %14.6g %14.6g   %s\n", history.channels[i].name.c_str(), mean, min, max,
                    history.channels[i].units.c_str());
    }
}

void write(const solvers::History& history, const std::string& path, const std::string& description) {
    solvers::HistoryWriter writer = solvers::HistoryWriter::create(
        path, history.channels, {.title = history.title, .method = "steady state", .description = description},
        {.replace = true});
    std::vector<double> row(history.channels.size());
    for (std::size_t k = 0; k < history.time.size(); ++k) {
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = history.values[i][k];
        writer.append(history.time[k], row);
    }
    writer.finish();
}

// At the wind with the largest thrust.
void tell_mesh(const turbines::WindRun& run, const WindResults& results, const RevolutionOptions& revolution) {
    if (run.ready.turbine.layout().blades.empty() || !dofs_of(run.machine.description).blades) return;
    const auto largest = std::ranges::max_element(results.points, {}, &turbines::WindOperatingPoint::thrust);
    const double wind = largest->operation.wind;
    progress(text("wind speed ", wind, " m/s with twice as many elements"));
    turbines::FinerPoint finer = finer_point(run, largest->operation);
    if (!finer.point.converged) {
        std::printf("with twice as many elements no steady state was found at %g m/s\n", wind);
        return;
    }
    std::vector<turbines::WindOperatingPoint> points;
    points.push_back(std::move(finer.point));
    const WindResults other = wind_results(finer.operation, std::move(points), revolution.stations, "");
    const auto index = static_cast<std::size_t>(largest - results.points.begin());
    std::printf("at %g m/s, and with twice as many elements: %s\n", wind, beside(results, index, other).c_str());
}

turbines::WindRunOptions run_options(const turbines::Machine& machine, const SteadyArguments& a,
                                     const std::vector<double>& winds) {
    return {.winds = winds,
            .operation = operation_of(a.wind),
            .air = settings_of(a.wind.air),
            .machine = numbers_of(a.machine),
            .gravity = a.machine.gravity,
            .harmonics = a.revolution.harmonics,
            .azimuths = a.revolution.azimuths,
            .max_frequency_hz = usual_frequency(machine, a.machine),
            .report = remarks_printed(a.machine.notes),
            .progress = [](int done, int total) { show_progress("wind speed", done, total); },
            .cancelled = interrupted};
}

// 130: interrupted, 1: some did not converge
int exit_code(const turbines::WindRun& run) {
    if (!run.complete) return 130;
    return run.not_converged.empty() ? 0 : 1;
}

int steady_in_wind(const turbines::Machine& machine, SteadyArguments& a, const std::vector<double>& winds,
                   const CommandLine& command) {
    const turbines::TurbineDescription& d = machine.description;
    stop_at_once();  // until a point is done
    turbines::WindRun run = turbines::wind_run(machine, run_options(machine, a, winds));
    keep_taken(run.options.machine, a.machine);
    if (a.machine.summary) std::cout << run.ready.turbine.summary() << "\n";
    turbines::find_points(run);
    stop_at_once();
    if (run.points.empty()) return run.complete ? 1 : 130;
    const int code = exit_code(run);
    const WindResults results =
        wind_results(run.operation, std::move(run.points), a.revolution.stations, text(d.name, ", in the wind"));
    write_csv(results, a.out);
    write_hdf5(results, a.out + ".h5", turbines::air_in_equilibrium(run.air),
               run_text("steady", command) + turbines::with_machine(run.ready.turbine.rotor().description, machine));
    std::printf("\n%s\n%s\n", results.title.c_str(), in_words(run.ready.mesh).c_str());
    if (!run.operation.is_constant())
        std::printf(
            "%d harmonics of the revolution; what those left out would have to balance, over stiffness: up to "
            "%.1e rad or m\n",
            a.revolution.harmonics, run.truncation_residual);
    if (run.truncation_residual > 1e-4)
        std::printf("that is little for means, but much for the minimum and maximum loads: take more, --harmonics\n");
    if (run.complete) tell_mesh(run, results, a.revolution);
    print(results);
    std::printf("\nfiles: %s.h5, .csv, _sections.csv", a.out.c_str());
    if (results.points.size() > 1) {
        draw_points(results, a.out);
        std::printf(", .svg, .png");
    }
    draw_sections(results, a.out);
    draw_coefficients(results.title, run.air.blade, run.air.options, d.blades, d.blade.cone, a.out);
    std::printf(", _sections.svg, .png, _coefficients.svg, .png\n");
    return code;
}

int run(SteadyArguments& a, const CommandLine& command) {
    a.machine.gravity = !a.no_gravity;
    const bool windy = !a.wind.speeds.empty();
    check_wind(a.wind, a.rpm ? text(*a.rpm) : "");
    if (windy && a.all) throw InputError("--all", "value", "given", "none beside --wind");
    if (windy && a.azimuth != 0) throw InputError("--azimuth", "value", a.azimuth, "none beside --wind");
    const std::vector<double> winds = winds_of(a.wind);
    static_cast<void>(stations_of(a.revolution.stations));
    if (a.out.empty()) a.out = default_prefix(a.machine.model, windy ? "wind" : "steady");
    check_outputs(a.out, {".h5", ".svg", ".png"}, {a.machine.model, a.wind.schedule});
    if (windy)
        check_outputs(
            a.out,
            {".csv", "_sections.csv", "_sections.svg", "_sections.png", "_coefficients.svg", "_coefficients.png"},
            {a.machine.model, a.wind.schedule});
    turbines::Machine machine = prepared_machine(a.machine);
    check_stations(machine, a.machine, a.revolution.stations);
    if (windy) {
        take_wind(machine, a.wind, a.machine);
        return steady_in_wind(machine, a, winds, command);
    }
    stop_at_once();  // nothing is kept
    const double speed = rotor_speed(a.rpm, machine);
    a.rpm = turbines::in_unit(speed, units::rpm);
    set_pitch(machine, a.machine, speed);
    const turbines::PreparedTurbine ready =
        ready_machine(machine, a.machine, usual_frequency(machine, a.machine), std::abs(speed));
    const turbines::Turbine& turbine = ready.turbine;
    const Revolution states = revolution(turbine, speed, a);
    const std::vector<ChannelGroup> groups = channels_of(turbine, a.revolution.stations);
    const solvers::History history = history_of(turbine.system(), groups, states.states,
                                                text(machine.description.name, ", steady at ", *a.rpm, " rpm"));
    std::printf("%s: %s\n%s\n", history.title.c_str(), states.about.c_str(), in_words(ready.mesh).c_str());
    print(history, a.all ? all_names(history.channels) : main_channels(turbine.layout(), history.channels));
    write(history, a.out + ".h5",
          run_text("steady", command) + turbines::with_machine(turbine.rotor().description, machine));
    std::printf("\nfiles: %s.h5 (%zu azimuths, %zu channels)", a.out.c_str(), history.time.size(),
                history.channels.size());
    if (history.time.size() > 1) {
        for (const char* ending : {".svg", ".png"})
            solvers::plot(history, usual_panels(turbine.layout(), history.channels), a.out + ending);
        std::printf(", .svg, .png");
    }
    std::printf("\n");
    return 0;
}

}  // namespace

int steady_command(int argc, char** argv) {
    return run_command<SteadyArguments>(
        "cardan steady",
        "Steady state of any machine at one rotor speed without wind, or with --wind over the wind speed.\n"
        "Prints the main channels; writes all over a revolution, or over the wind speed, to PREFIX.h5, and pictures "
        "to PREFIX.svg and .png.",
        argc, argv, declare, run);
}

}  // namespace cardan::program
