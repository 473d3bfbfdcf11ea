// A user-defined force: a spring that hardens, Q = -k q - c q^3, with its energy and its derivatives. The period of
// the oscillation depends on the amplitude; it is known in closed form (Duffing's equation without damping).
#include <cardan/elements/machine_elements/joints.hpp>
#include <cardan/mbs/base/units.hpp>
#include <cardan/solvers/time/integrate.hpp>

#include <cmath>
#include <cstdio>

int main() {
    using namespace cardan;
    constexpr double mass = 2, k = 50, c = 400;  // kg, N/m, N/m^3
    Tree tree;
    const JointedFrame slide = add_joint(tree, Tree::base(), JointKind::prismatic, Axis::x, "slide", {"mass"});
    tree.weld(slide.frame, {.mass = mass});

    ForceElement spring{.name = "hardening spring", .coordinates = {slide.body}, .elastic = true};
    spring.evaluate = [](const ElementView& at, ElementForces& out) {
        out.Q(0) = -k * at.q(0) - c * std::pow(at.q(0), 3);
    };
    spring.jacobian = [](const ElementView& at, ElementJacobian& d) { d.Q_q(0, 0) = -k - 3 * c * at.q(0) * at.q(0); };
    spring.potential = [](const ElementView& at) {
        return k * std::pow(at.q(0), 2) / 2 + c * std::pow(at.q(0), 4) / 4;
    };
    ForceSet forces;
    forces.add_element(spring);
    const System system(tree, forces);

    // Let go at the amplitude; it comes back after a period, when its speed falls through zero.
    solvers::IntegrationOptions options;
    options.tolerances.relative = 1e-9;
    options.events = {{.name = "back", .function = [](const StateView& at) { return at.qd(0); }, .direction = -1}};
    std::printf("amplitude    period computed   closed form   (m, s)   error of energy, J\n");
    for (const double amplitude : {0.01, 0.3, 1.0}) {
        solvers::Integrator integrator(system, {}, 0, Vector{{amplitude}}, Vector{{0.0}}, options);
        const solvers::Advance end = integrator.advance(10);
        const double stiffness = k + c * amplitude * amplitude;
        const double modulus = std::sqrt(c * amplitude * amplitude / (2 * stiffness));
        std::printf("%9.2f %18.8f %13.8f %25.1e\n", amplitude, end.time,
                    4 * std::comp_ellint_1(modulus) / std::sqrt(stiffness / mass), integrator.energy().error);
    }
}
