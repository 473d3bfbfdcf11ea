// A motor with a commutator on an arm, switched on at 4 V: it lifts the arm until the weight balances its torque. A
// flux in proportion to the angle is what a commutator makes: torque k i, voltage k q'. The roots about the end are
// those of (J s^2 + m g l cos q)(L s + R) + k^2 s; motor_arm.svg shows angle and current.
#include <cardan/elements/electric/circuit.hpp>
#include <cardan/elements/machine_elements/joints.hpp>
#include <cardan/mbs/base/error.hpp>
#include <cardan/mbs/base/units.hpp>
#include <cardan/solvers/equilibrium/steady_state.hpp>
#include <cardan/solvers/linear/modes.hpp>
#include <cardan/solvers/pictures/history.hpp>
#include <cardan/solvers/time/recorder.hpp>

#include <cmath>
#include <cstdio>
#include <iostream>

using namespace cardan;

int main() try {
    constexpr double m = 0.3, l = 0.5, k = 0.4, L = 0.02, R = 1.4, V = 4, g = units::standard_gravity;
    Tree tree;
    const JointedFrame arm = add_joint(tree, Tree::base(), JointKind::revolute, Axis::y, "angle", {"arm"});
    tree.weld(arm.frame, {.mass = m, .com = Vec3(0, 0, -l)});
    Circuit motor({.name = "motor", .current = 3, .voltage = V});
    motor.add_source({.name = "supply", .from = "ground", .to = "brush", .over_time = [](double) { return V; }});
    motor.add_winding({.name = "armature", .from = "brush", .to = "ground", .inductance = L, .resistance = R});
    motor.add_magnet("armature", arm.body, [](double q) { return Curve{k * q, k, 0}; });
    ForceSet forces;
    forces.set_gravity({0, 0, -g});
    forces.add_element(motor.element());
    const System system(tree, forces);

    const solvers::SteadyState end = solvers::steady_state(system, -1);
    require_result(end, "the arm held up");
    const double q = end.at.q(0), J = m * l * l;
    std::printf("angle %.6f deg, by hand %.6f deg\n", q * units::to_degrees,
                std::asin(k * V / R / (m * g * l)) * units::to_degrees);
    for (const solvers::Mode& mode : solvers::modes(solvers::restrict_to(solvers::linearise(system, end.at), {0}))) {
        const Complex s = mode.eigenvalue, weight = m * g * l * std::cos(q);
        std::printf("root %9.4f %+9.4f i, residual %.0e\n", s.real(), s.imag(),
                    std::abs((J * s * s + weight) * (L * s + R) + k * k * s) / (std::abs(weight) * R));
    }
    solvers::Integrator run(system, {}, 0, Vector{{0.0}}, Vector{{0.0}});
    solvers::Recorder recorder(run, {motor.channels()});
    solvers::History history;
    history.title = "A motor lifts an arm";
    require_result(solvers::record(run, recorder, solvers::sample_times(0, 6, 0.01), history));
    solvers::plot(history, {{{"angle"}}, {{"armature current"}}}, "motor_arm.svg");
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
