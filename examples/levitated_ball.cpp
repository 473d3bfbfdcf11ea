// A circuit and a body in one system: an iron ball under a magnet whose voltage follows the gap and its rate. The
// inductance L(x) = L1 + c / (gap + x) makes the force and the voltage of motion. At constant current the ball falls
// off with the root sqrt(2 g / gap); with the controller all roots are on the left, those of the 3 x 3 system by hand:
// m s^2 - i^2 L''/2 = i L' I, (L s + R) I = P + (D - L' i) s.
#include <cardan/elements/electric/circuit.hpp>
#include <cardan/elements/machine/joints.hpp>
#include <cardan/mbs/base/units.hpp>
#include <cardan/solvers/equilibrium/steady_state.hpp>
#include <cardan/solvers/linear/modes.hpp>
#include <cardan/solvers/time/integrate.hpp>

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
    forces.add_states(magnet.element());
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
    std::printf("\ntime, s   gap, mm   flux, V s   error of the balance of the field, J\n");
    for (const double time : {0.0, 0.02, 0.05, 0.1, 0.3}) {
        solvers::require_result(run.advance(time));
        std::printf("%7.2f %9.4f %11.5f %12.1e\n", time, 1e3 * (gap + run.state().q(0)), run.state().s(0),
                    run.energy().state_error);
    }
}
