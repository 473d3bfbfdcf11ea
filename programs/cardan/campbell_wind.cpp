// Aeroelastic Campbell diagram of any machine over the wind speed.
//
// Problem: at every wind speed the machine is brought to its operating point as `cardan steady --wind` does; about the
// steady state in the air the motion is linearised with air that is frozen, in equilibrium, or lags behind it, and
// modes are followed from one wind speed to the next. Where the state depends on the azimuth (gravity, tilt, shear) the
// modes are those of the mean over the azimuth in multi-blade coordinates, with two blades or on demand Floquet's.
// Motions of the air alone are apart: no vibrations of the machine.
#include "programs/cardan/campbell_wind.hpp"

#include "programs/cardan/operation.hpp"
#include "programs/shared/campbell_program.hpp"
#include <cstdio>

namespace cardan::program {

namespace {

constexpr int azimuths_of_states = 24;

void write_wind_diagram(const solvers::Campbell& diagram, const std::string& prefix, double max_frequency,
                        bool air_roots) {
    solvers::CampbellPlotOptions picture;
    picture.states = air_roots;
    picture.max_frequency_hz = max_frequency;
    picture.title = title_of(diagram);
    picture.log_damping = true;
    write_files_and_roots(diagram, diagram, prefix, picture);
}

}  // namespace

turbines::AeroelasticOptions air_that_lags(const VibrationArguments& a, const turbines::Aerodynamics& air) {
    turbines::AeroelasticOptions options;
    // Without induced velocities none can lag.
    if (a.wind.air.wake != "none") options.wake = turbines::wake_named(a.wind.air.wake, "--wake");
    if (!a.steady_profiles) options.profiles = air.unsteady_airfoils;
    return options;
}

std::string vibration_in_words(const turbines::Aerodynamics& air, const turbines::AeroelasticOptions& options) {
    return air_in_words(air.options.induction ? name_of(options.wake) : "none", !options.profiles.empty());
}

void add_vibration_options(CommandLine& app, VibrationArguments& a) {
    add_wind_options(app, a.wind);
    app.add_option("--wake", a.wind.air.wake,
                   "how the induced velocities follow a vibration: frozen (not at all), quasi-steady (at once) or "
                   "dynamic; none: there are none")
        .one_of({"frozen", "quasi-steady", "dynamic", "none"});
    app.add_flag("--steady-profiles", a.steady_profiles,
                 "lift, drag and moment follow the angle of attack at once, also where the profiles' data have lags");
    app.add_option("--harmonics", a.harmonics, "harmonics of the revolution that are balanced, with --wind")
        .range(1, 200);
}

int campbell_in_wind(const turbines::Machine& machine, MachineOptions& options, const VibrationArguments& a,
                     double max_frequency, const std::string& prefix, bool air_roots, const CommandLine& command) {
    WindRun run = wind_run(machine, options, a.wind, a.harmonics, azimuths_of_states, max_frequency);
    const turbines::AeroelasticOptions air = air_that_lags(a, run.air);
    check_outputs(prefix, {".h5", ".csv", ".svg", ".png", "_roots.svg", "_roots.png"});
    find_points(run, machine, options, a.wind);
    if (run.points.empty()) return run.complete ? 1 : 130;
    tell_air("vibrations", vibration_in_words(run.air, air));

    solvers::CampbellOptions modes = campbell_options(max_frequency);
    modes.progress = [](int done, int total) {
        progress(text("\rmodes at wind speed ", done, " of ", total, done == total ? "\n" : ""));
    };
    modes.spin = rotor_spin(machine);
    modes.floquet.harmonics = a.harmonics;
    modes.all_state_motions = air_roots;
    if (a.floquet) modes.method = solvers::CampbellMethod::floquet;
    solvers::Campbell diagram = turbines::aeroelastic_campbell(run.operation, run.points, air, modes);
    stop_at_once();
    diagram.remark = vibration_in_words(run.air, air);
    tell_origin(diagram, "campbell", command, machine, run.ready);
    print_table(diagram);
    if (diagram.points.empty()) return 130;
    write_wind_diagram(diagram, prefix, max_frequency, air_roots);
    return diagram.complete ? run.exit_code() : 130;
}

}  // namespace cardan::program
