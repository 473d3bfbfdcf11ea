// A circuit and a body in one system: an iron ball under a magnet whose voltage follows the gap and its rate. The
// inductance L(x) = L1 + c / (gap + x) makes the force and the voltage of motion. At constant current the ball falls
// off with the root sqrt(2 g / gap); with the controller all roots are on the left, those of the 3 x 3 system by hand:
// (m s^2 - i^2 L''/2)(L s + R) = i L' (P + (D - L' i) s). levitated_ball.svg shows gap and current.
#include <cardan/elements/electric/circuit.hpp>
#include <cardan/elements/machine_elements/joints.hpp>
#include <cardan/mbs/base/units.hpp>
#include <cardan/solvers/equilibrium/steady_state.hpp>
#include <cardan/solvers/linear/modes.hpp>
#include <cardan/solvers/pictures/history.hpp>
#include <cardan/solvers/time/recorder.hpp>

#include <cmath>
#include <cstdio>

int main() {
    using namespace cardan;
    constexpr double m = 0.4, L1 = 0.02, c = 3e-4, R = 2, gap = 0.01, P = 4000, D = 150, g = units::standard_gravity;
    const double i = gap * std::sqrt(2 * m * g / c), slope = -c / (gap * gap), curvature = 2 * c / (gap * gap * gap);
    Tree tree;
    const JointedFrame ball = add_joint(tree, Tree::base(), JointKind::prismatic, Axis::z, "gap", {"ball"});
    tree.weld(ball.frame, {.mass = m});

    Circuit magnet({.name = "magnet", .current = 2, .voltage = 10});
    magnet.add_source(
        {.name = "amplifier",
         .from = "ground",
         .to = "coil end",
         .signal = signal::constant(R * i) + P * signal::position(ball.body) + D * signal::rate(ball.body)});
    magnet.add_winding({.name = "coil", .from = "coil end", .to = "ground", .inductance = L1, .resistance = R});
    magnet.vary("coil", "coil", ball.body, [](double x) {
        const double y = gap + x;
        return Curve{c / y, -c / (y * y), 2 * c / (y * y * y)};
    });
    ForceSet forces;
    forces.set_gravity({0, 0, g});  // z downwards
    forces.add_element(magnet.element());
    const System system(tree, forces);

    solvers::SteadyOptions start;
    start.states = Vector{{(L1 + c / gap) * i}};
    const solvers::SteadyState rest = solvers::steady_state(system, -1, start);
    require_result(rest, "the ball at rest");
    std::printf("root, 1/s                residual of the characteristic equation, relative\n");
    for (const solvers::Mode& mode : solvers::modes(solvers::restrict_to(solvers::linearise(system, rest.at), {0}))) {
        const Complex s = mode.eigenvalue, plant = m * s * s - i * i * curvature / 2, coil = (L1 + c / gap) * s + R,
                      loop = i * slope * (P + (D - slope * i) * s);
        std::printf("%9.3f %+9.3f i %20.1e\n", s.real(), s.imag(), std::abs(plant * coil - loop) / std::abs(loop));
    }
    solvers::IntegrationOptions options;
    options.states = rest.at.s;
    solvers::Integrator run(system, {}, 0, Vector{{0.002}}, Vector{{0.0}}, options);  // dropped 2 mm too low
    solvers::Recorder recorder(run, {magnet.channels()});
    solvers::History history;
    history.title = "A ball under a magnet, dropped 2 mm too low";
    require_result(solvers::record(run, recorder, solvers::sample_times(0, 1, 2e-3), history));
    solvers::plot(history, {{{"gap"}}, {{"coil current"}}}, "levitated_ball.svg");
    std::printf("gap at the end %.6f mm too large; error of the balance of the field %.0e J\n", 1e3 * run.state().q(0),
                run.energy().state_error);
}
