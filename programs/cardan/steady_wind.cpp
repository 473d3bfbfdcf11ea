// Operating points of a machine over the wind speed: blade-element momentum on the bent, turning blades.
//
// Problem: at every wind speed the rotor turns at the speed, with the pitch, that a schedule gives, or that a machine
// of variable speed chooses: best tip-speed ratio at the fine pitch, beyond rated power rated speed and the pitch that
// holds it. The rotor is in its steady state, deformed, periodic where gravity, tilt or the wind make it so.
// Checked: what the neglected harmonics would have to balance is printed; what does not converge is named.
#include "programs/cardan/steady_wind.hpp"

#include "programs/cardan/operation.hpp"
#include "programs/cardan/wind_results.hpp"
#include "programs/shared/program.hpp"
#include "programs/shared/words.hpp"
#include "turbines/machine/machine_text.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace cardan::program {

namespace {

// At the wind with the largest thrust.
void tell_mesh(const turbines::WindRun& run, const WindResults& results, const RevolutionOptions& revolution) {
    if (run.ready.turbine.layout().blades.empty() || !dofs_of(run.machine.description).blades) return;
    const auto largest = std::ranges::max_element(results.points, {}, &turbines::WindPoint::thrust);
    const double wind = largest->operation.wind;
    progress(text("wind speed ", wind, " m/s with twice as many elements"));
    turbines::FinerPoint finer = finer_point(run, largest->operation);
    if (!finer.point.converged) {
        std::printf("with twice as many elements no steady state was found at %g m/s\n", wind);
        return;
    }
    std::vector<turbines::WindPoint> points;
    points.push_back(std::move(finer.point));
    const WindResults other = wind_results(finer.operation, std::move(points), revolution.stations, "");
    const auto index = static_cast<std::size_t>(largest - results.points.begin());
    std::printf("at %g m/s, and with twice as many elements: %s\n", wind, beside(results, index, other).c_str());
}

turbines::WindRunOptions run_options(const turbines::Machine& machine, const MachineOptions& options,
                                     const WindArguments& wind, const std::vector<double>& winds,
                                     const RevolutionOptions& revolution) {
    return {.winds = winds,
            .operation = operation_of(wind),
            .air = settings_of(wind.air),
            .machine = numbers_of(options),
            .gravity = options.gravity,
            .harmonics = revolution.harmonics,
            .azimuths = revolution.azimuths,
            .max_frequency_hz = usual_frequency(machine, options),
            .report = remarks_printed(options.notes),
            .progress = [](int done, int total) { show_progress("wind speed", done, total); },
            .cancelled = interrupted};
}

// 130: interrupted, 1: some did not converge
int exit_code(const turbines::WindRun& run) {
    if (!run.complete) return 130;
    return run.not_converged.empty() ? 0 : 1;
}

}  // namespace

int steady_in_wind(const turbines::Machine& machine, MachineOptions& options, const WindArguments& wind,
                   const std::vector<double>& winds, const RevolutionOptions& revolution, const std::string& prefix,
                   const CommandLine& command) {
    const turbines::TurbineDescription& d = machine.description;
    stop_at_once();  // until a point is done
    turbines::WindRun run = turbines::wind_run(machine, run_options(machine, options, wind, winds, revolution));
    keep_taken(run.options.machine, options);
    if (options.summary) std::cout << run.ready.turbine.summary() << "\n";
    turbines::find_points(run);
    stop_at_once();
    if (run.points.empty()) return run.complete ? 1 : 130;
    const int code = exit_code(run);
    const WindResults results =
        wind_results(run.operation, std::move(run.points), revolution.stations, text(d.name, ", in the wind"));
    write_csv(results, prefix);
    write_hdf5(results, prefix + ".h5", turbines::air_in_equilibrium(run.air),
               run_text("steady", command) + turbines::with_machine(run.ready.turbine.rotor().description, machine));
    std::printf("\n%s\n%s\n", results.title.c_str(), in_words(run.ready.mesh).c_str());
    if (!run.operation.is_constant())
        std::printf(
            "%d harmonics of the revolution; what those left out would have to balance, over stiffness: up to "
            "%.1e rad or m\n",
            revolution.harmonics, run.truncation_residual);
    if (run.truncation_residual > 1e-4)
        std::printf("that is little for means, but much for the least and largest loads: take more, --harmonics\n");
    if (run.complete) tell_mesh(run, results, revolution);
    print(results);
    std::printf("\nfiles: %s.h5, .csv, _sections.csv", prefix.c_str());
    if (results.points.size() > 1) {
        draw_points(results, prefix);
        std::printf(", .svg, .png");
    }
    draw_sections(results, prefix);
    draw_coefficients(results.title, run.air.blade, run.air.options, d.blades, d.blade.cone, prefix);
    std::printf(", _sections.svg, .png, _coefficients.svg, .png\n");
    return code;
}

}  // namespace cardan::program
