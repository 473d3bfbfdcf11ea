// A direct-drive generator with permanent magnets in a sag of the grid to half its voltage. Before, the grid takes the
// power of the shaft less the losses in the windings, 3/2 R i^2 with i = T / (3/2 p psi); in the sag what the limit of
// current allows, 3/2 u i_max, and the chopper burns the rest. The torque stays. Picture: grid_sag.svg.
#include <cardan/elements/electric/synchronous_generator.hpp>
#include <cardan/elements/machine_elements/joints.hpp>
#include <cardan/mbs/base/error.hpp>
#include <cardan/solvers/pictures/history.hpp>
#include <cardan/solvers/time/recorder.hpp>

#include <cstdio>
#include <iostream>

using namespace cardan;

int main() try {
    constexpr double speed = 2.2, torque = 8e5, left = 0.5;  // rad/s, N m, of the voltage
    Tree tree;
    const JointedFrame shaft =
        add_joint(tree, Tree::base(), JointKind::revolute, Axis::x, "shaft", {"generator"}, CoordinateRole::prescribed);
    const PermanentMagnetMachine machine{
        .pole_pairs = 40, .resistance = 0.006, .inductance_d = 1.5e-3, .inductance_q = 1.7e-3, .magnet_flux = 6.5};
    const Grid grid{.line_voltage = 690, .frequency = 50};
    const SynchronousGenerator generator{.shaft = shaft.body,
                                         .machine = machine,
                                         .link = {.voltage = 1100, .capacitance = 0.09, .chopper = 0.5},
                                         .grid = grid.with_sag(1 - left, 0.3, 0.15),
                                         .torque = signal::constant(torque),
                                         .current_limit = 3000,
                                         .running_speed = speed,
                                         .running_torque = torque};
    ForceSet forces;
    forces.add_element(synchronous_generator(generator));
    const System system(tree, forces);
    solvers::Integrator run(system, {}, 0, Vector{{0.0}}, Vector{{speed}});
    solvers::Recorder recorder(run, {synchronous_generator_channels(generator)});
    solvers::History history;
    history.title = "A generator with permanent magnets in a sag of the grid";
    require_result(solvers::record(run, recorder, solvers::sample_times(0, 1, 0.001), history));

    const double current = torque / (1.5 * machine.pole_pairs * machine.magnet_flux),
                 power = torque * speed - 1.5 * machine.resistance * current * current,
                 max = 1.5 * left * grid.peak() * generator.current_limit;
    std::printf("kW            time, s   into the grid      by hand      chopper      by hand   torque, kN m\n");
    const auto print = [&](const char* when, std::size_t at, double to_grid, double burnt) {
        std::printf("%-12s %8.3f %15.3f %12.3f %12.3f %12.3f %14.3f\n", when, history.time[at],
                    history["generator power"][at] / 1e3, to_grid / 1e3, history["generator chopper power"][at] / 1e3,
                    burnt / 1e3, history["generator torque"][at] / 1e3);
    };
    print("before", 250, power, 0);
    print("in the sag", 440, max, power - max);
    print("after", 1000, power, 0);
    solvers::plot(history, {{{"generator power", "generator chopper power"}}, {{"generator link voltage"}}},
                  "grid_sag.svg");
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
