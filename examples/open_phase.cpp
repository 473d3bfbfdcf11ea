// An induction machine that has lost a phase, in phase quantities: at constant speed its torque pulsates at twice the
// frequency of the grid. The lines that are left carry I = V / (Z1 + Z2), with the impedances of the equivalent circuit
// at the slips s and 2 - s; the torque is 3/2 |I|^2 p/w (Re(Z1 - Z2) + |Z1 - Z2| cos(2 w t + phase)).
#include <cardan/elements/electric/three_phase.hpp>
#include <cardan/elements/machine_elements/joints.hpp>
#include <cardan/mbs/base/error.hpp>
#include <cardan/solvers/signals/harmonics.hpp>
#include <cardan/solvers/time/recorder.hpp>

#include <algorithm>
#include <cstdio>
#include <iostream>

using namespace cardan;

int main() try {
    const EquivalentCircuit c{.stator_resistance = 0.435,
                              .stator_leakage = 0.754,
                              .magnetising = 26.13,
                              .rotor_leakage = 0.754,
                              .rotor_resistance = 0.816,
                              .frequency = 60,
                              .pole_pairs = 2};
    const Grid grid{.line_voltage = 220, .frequency = 60};
    Tree tree;
    const JointedFrame shaft =
        add_joint(tree, Tree::base(), JointKind::revolute, Axis::x, "shaft", {"generator"}, CoordinateRole::prescribed);
    const Circuit machine = three_phase_machine({.shaft = shaft.body, .circuit = c, .grid = grid, .open_phase = 2});
    ForceSet forces;
    forces.add_element(machine.element());
    const System system(tree, forces);

    std::printf("   slip   mean torque   by formula   at 120 Hz   by formula   largest other harmonic   (N m)\n");
    for (const double slip : {0.04, -0.04, -0.08}) {
        solvers::Integrator run(system, {}, 0, Vector{{0.0}}, Vector{{(1 - slip) * c.synchronous_speed()}});
        require_result(run.advance(2));  // until the transient has died out
        solvers::Recorder recorder(run, {machine.channels()});
        solvers::History history;
        require_result(solvers::record(run, recorder, solvers::sample_times(2, 2.1, 1. / 3000), history));
        const solvers::Harmonics torque =
            solvers::harmonics(history.time, history["generator force on 1"], grid.frequency, 4);

        const auto rotor = [&c](double s) {  // and the magnetising reactance beside it
            const Complex branch(c.rotor_resistance / s, c.rotor_leakage), magnetising(0, c.magnetising);
            return magnetising * branch / (magnetising + branch);
        };
        const Complex stator(c.stator_resistance, c.stator_leakage), difference = rotor(slip) - rotor(2 - slip),
                                                                     sum = rotor(slip) + rotor(2 - slip);
        const double factor =
            1.5 * std::norm(grid.peak() / (2.0 * stator + sum)) * c.pole_pairs / grid.omega();  // N m/ohm
        std::printf("%7.2f %13.4f %12.4f %11.4f %12.4f %24.1e\n", slip, torque.mean, factor * difference.real(),
                    torque.amplitude[1], factor * std::abs(difference),
                    std::max({torque.amplitude[0], torque.amplitude[2], torque.amplitude[3]}));
    }
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
