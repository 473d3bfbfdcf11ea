#include "examples/studies/nrel5mw_controlled/simulate.hpp"
#include "examples/studies/nrel5mw_controlled/studies.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/program.hpp"
#include "solvers/pictures/history.hpp"

#include <cmath>
#include <cstdio>

namespace cardan::controlled {

namespace {

// Drive train, and the mode of the speed loop beside it.
void print(const char* what, const LinearLoop& loop, const Plant& plant) {
    const solvers::Mode shaft = drive_train_mode(loop);
    std::printf("%-16s %10.4f Hz %9.3f %%", what, shaft.natural_hz(), 100 * shaft.damping_ratio());
    if (plant.point.wind > rated_wind) {
        const solvers::Mode& speed = elastic_loop(loop, rigid_loop(plant.point, rotor_inertia(plant)));
        std::printf(" %14.4f rad/s %9.4f", std::abs(speed.eigenvalue), speed.damping_ratio());
    }
    std::printf("\n");
}

}  // namespace

int damper(const MachineOptions& machine, const DamperStudy& options, const std::string& out) {
    require_positive("--gain", "value [N m s/rad]", options.gain);
    require_positive("--width", "damping ratio of the band pass", options.width);
    require_positive("--duration", "value [s]", options.duration);
    winds("--wind", text(options.wind));
    program::check_outputs(out, {".svg", ".png"});
    const Plant here = plant(machine, options.wind);
    const LinearLoop without = linear_loop(here, {});
    const DamperOptions damper{options.gain, std::abs(drive_train_mode(without).eigenvalue), options.width};
    const LinearLoop with = linear_loop(here, damper);
    std::printf("%-16s %13s %11s %20s %9s\n", "drive train", "", "damping", "speed loop", "damping");
    print("without damper", without, here);
    print("with damper", with, here);

    const WindSteps step{{options.wind, options.wind + options.change}, 1};
    solvers::History both = response(here, step, {}, options.duration, 0.01, "main shaft twist", "without damper");
    if (program::interrupted()) return 130;
    const solvers::History damped =
        response(here, step, damper, options.duration, 0.01, "main shaft twist", "with damper");
    if (program::interrupted()) return 130;
    both.title = "Twist of the main shaft after a step of the rotor's torque, NREL 5 MW machine";
    both.channels.push_back(damped.channels.front());
    both.values.push_back(damped.values.front());
    for (const char* ending : {".svg", ".png"})
        solvers::plot(both, {{{"without damper", "with damper"}}}, out + ending);
    std::printf("\nfiles: %s.svg, .png\n", out.c_str());
    return drive_train_mode(with).damping_ratio() > drive_train_mode(without).damping_ratio() ? 0 : 3;
}

}  // namespace cardan::controlled
