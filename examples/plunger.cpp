// A coil draws a plunger in against a spring, switched on at 24 V. The inductance L0 / (1 + x / a)^2 makes the force;
// the plunger's speed makes a voltage, which shows as a dent in the current (plunger.svg). At the end k x + i^2 L'/2 =
// 0.
#include <cardan/elements/electric/circuit.hpp>
#include <cardan/elements/machine_elements/joints.hpp>
#include <cardan/mbs/base/error.hpp>
#include <cardan/solvers/pictures/history.hpp>
#include <cardan/solvers/time/recorder.hpp>

#include <cstdio>
#include <iostream>

using namespace cardan;

int main() try {
    constexpr double m = 0.05, k = 2e4, d = 40, L0 = 0.05, a = 0.02, R = 6, V = 24;  // kg, N/m, N s/m, H, m, ohm, V
    const CurveOf inductance = [](double x) {
        const double y = 1 + x / a;
        return Curve{L0 / (y * y), -2 * L0 / (a * y * y * y), 6 * L0 / (a * a * y * y * y * y)};
    };
    Tree tree;
    const JointedFrame slide = add_joint(tree, Tree::base(), JointKind::prismatic, Axis::x, "position", {"plunger"});
    tree.weld(slide.frame, {.mass = m});
    Circuit coil({.name = "solenoid", .current = 4, .voltage = V});
    coil.add_source({.name = "battery", .from = "ground", .to = "plus", .over_time = [](double) { return V; }});
    coil.add_winding({.name = "coil", .from = "plus", .to = "ground", .resistance = R});
    coil.vary("coil", "coil", slide.body, inductance);
    ForceSet forces;
    forces.add_spring("spring", slide.body, k, d);
    forces.add_element(coil.element());
    const System system(tree, forces);

    solvers::Integrator run(system, {}, 0, Vector{{0.0}}, Vector{{0.0}});
    solvers::Recorder recorder(run, {coil.channels()});
    solvers::History history;
    history.title = "A plunger is drawn into a coil";
    require_result(solvers::record(run, recorder, solvers::sample_times(0, 0.5, 5e-4), history));
    solvers::plot(history, {{{"position"}}, {{"coil current"}}}, "plunger.svg");

    const double x = run.state().q(0), i = history["coil current"].back(), force = i * i * inductance(x).slope / 2;
    std::printf("position %.4f mm, current %.4f A; spring %.4f N, field %.4f N\n", 1e3 * x, i, -k * x, force);
    const solvers::EnergyBalance energy = run.energy();
    std::printf("energy, J: from the battery %.4f, lost in the coil %.4f, in the field %.4f, error %.0e\n",
                energy.state_supply, energy.state_dissipation, energy.stored, energy.state_error);
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
