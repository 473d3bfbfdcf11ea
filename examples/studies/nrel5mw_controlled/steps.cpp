#include "examples/studies/nrel5mw_controlled/simulate.hpp"
#include "examples/studies/nrel5mw_controlled/studies.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/simulation_run.hpp"

#include <cmath>
#include <cstdio>

namespace cardan::controlled {

namespace {

constexpr double speed_allowed = 0.005, pitch_allowed = 0.3;  // part; deg: after a stretch, from the steady point

// What was reached at the end of a stretch beside the steady point.
bool print_stretch(const solvers::History& history, std::size_t end, const SteadyPoint& wanted) {
    const double rpm = history["RotSpeed"][end] * units::to_rpm, pitch = history["BldPitch1"][end] * units::to_degrees,
                 torque = history["GenTq"][end], power = history["generator power"][end];
    const double wanted_rpm = wanted.rotor_speed * units::to_rpm, wanted_pitch = wanted.pitch * units::to_degrees;
    const bool settled =
        std::abs(rpm / wanted_rpm - 1) < speed_allowed && std::abs(pitch - wanted_pitch) < pitch_allowed;
    std::printf("%7.1f %6.1f %9.3f %9.3f %8.2f %8.2f %9.2f %9.2f %8.3f %8.3f  %s\n", history.time[end], wanted.wind,
                rpm, wanted_rpm, pitch, wanted_pitch, torque / 1e3, wanted.torque / 1e3, power / 1e6,
                wanted.rotor_torque * wanted.rotor_speed / 1e6, settled ? "" : "not settled");
    return settled;
}

bool print_stretches(const solvers::History& history, const WindSteps& wind) {
    std::printf("\n%7s %6s %19s %17s %19s %17s\n", "time, s", "wind", "rotor speed, rpm", "pitch, deg", "torque, kN m",
                "power, MW");
    std::printf("%7s %6s %9s %9s %8s %8s %9s %9s %8s %8s\n", "", "m/s", "", "steady", "", "steady", "", "steady", "",
                "steady");
    bool good = true;
    std::size_t end = 0;
    for (std::size_t i = 0; i < wind.winds.size(); ++i) {
        const double until = wind.every * static_cast<double>(i + 1);
        while (end + 1 < history.time.size() && history.time[end + 1] < until - 1e-9) ++end;
        if (history.time[end] < until - wind.every) break;  // interrupted before
        good = print_stretch(history, end, steady_point(wind.winds[i])) && good;
    }
    return good;
}

}  // namespace

int steps(const MachineOptions& machine, const StepsOptions& options, const std::string& out) {
    if (!(options.every >= 1)) throw InputError("--every", "value [s]", options.every, ">= 1");
    const WindSteps wind{winds("--winds", options.winds), options.every};
    program::RunArguments run;
    run.duration = wind.duration();
    run.step = options.step;
    run.tolerance = options.tolerance;
    run.out = out;
    program::check_run_options(run);
    program::check_outputs(out, program::run_outputs);
    const Plant start = plant(machine, wind.winds.front());
    DamperOptions damper;
    if (options.gain != 0) {
        damper.frequency = std::abs(drive_train_mode(linear_loop(start, {})).eigenvalue);
        damper.gain = options.gain;
    }
    Simulation simulation(start, wind, damper, options.tolerance);
    const std::string title = "NREL 5 MW machine under the baseline controller in steps of the rotor's torque";
    const std::string about =
        text("winds ", options.winds, " m/s, each for ", options.every, " s, ", program::options_text(run), ", damper ",
             damper.gain, " N m s/rad\n", simulation.turbine().rotor().description);
    program::Rows rows(title, about, run, simulation.integrator(), simulation.recorder());
    const program::Stopwatch watch;
    const solvers::Advance end =
        program::record(simulation.integrator(), simulation.recorder(), 0, run.duration, run.step, rows);
    const program::Elapsed elapsed = watch.elapsed();
    program::progress("\r                              \r");
    const bool settled = print_stretches(rows.history(), wind);
    std::printf("\n");
    const bool balanced =
        program::check_energy(simulation.integrator().energy(),
                              program::largest(rows.history(), "kinetic energy").value, 10 * options.tolerance);
    program::print_effort(simulation.integrator(), simulation.turbine().system(), elapsed);
    program::write_outputs(rows, out, end.reached(),
                           {{{"wind speed"}},
                            {{"RotSpeed"}},
                            {{"pitch demand", "BldPitch1"}},
                            {{"torque demand", "GenTq"}},
                            {{"rotor power", "generator power", "GenPwr"}},
                            {{"TTDspSS"}}},
                           {}, {});
    if (!end.reached()) return 130;
    return !balanced ? 1 : settled ? 0 : 3;
}

}  // namespace cardan::controlled
