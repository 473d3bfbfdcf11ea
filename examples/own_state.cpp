// An element of one's own with a state of first order: a rubber bush that creeps (Maxwell's element, a spring k and a
// damper c in series, whose force obeys F' = k v - k/c F) beside a spring. The three roots of
// (m L^2 + k0) (L + k/c) + k L = 0 are the modes, and the decay in time is that of the slowest.
#include <cardan/elements/machine_elements/joints.hpp>
#include <cardan/solvers/linear/modes.hpp>
#include <cardan/solvers/time/integrate.hpp>

#include <cstdio>

int main() {
    using namespace cardan;
    constexpr double mass = 2, k0 = 30, k = 80, c = 5;  // kg, N/m, N/m, N s/m
    Tree tree;
    const JointedFrame slide = add_joint(tree, Tree::base(), JointKind::prismatic, Axis::x, "slide", {"mass"});
    tree.weld(slide.frame, {.mass = mass});

    ForceElement bush{
        .name = "bush", .states = {{.name = "creeping force", .unit = "N", .scale = 10}}, .coordinates = {slide.body}};
    bush.evaluate = [](const ElementView& in, ElementForces& out) {
        out.Q(0) = -in.s(0);
        out.f(0) = k * in.qd(0) - k / c * in.s(0);
    };
    bush.power = [](const ElementView& in) {
        return ElementPower{.stored = in.s(0) * in.s(0) / (2 * k), .dissipated = in.s(0) * in.s(0) / c};
    };
    ForceSet forces;
    forces.add_spring("spring", slide.body, k0);
    forces.add_element(bush);
    const System system(tree, forces);

    const Vector zero = Vector::Zero(1);
    std::printf("eigenvalue, 1/s          residual of the cubic   share of the state\n");
    for (const solvers::Mode& mode :
         solvers::modes(solvers::restrict_to(solvers::linearise(system, at_rest(zero)), {0}))) {
        const Complex L = mode.eigenvalue, rest = (mass * L * L + k0) * (L + k / c) + k * L;
        std::printf("%9.5f %+9.5f i %23.1e %20.3f %s\n", L.real(), L.imag(), std::abs(rest), mode.state_share,
                    mode.is_state_motion() ? " a motion of the state" : " a vibration");
    }

    solvers::Integrator integrator(system, {}, 0, Vector{{0.3}}, zero);
    std::printf("\ntime, s   position, m   force, N   energy lost in the bush, J   error, J\n");
    for (const double time : {0.0, 1.0, 2.0, 4.0}) {
        solvers::require_result(integrator.advance(time));
        const solvers::EnergyBalance energy = integrator.energy();
        std::printf("%7.1f %13.6f %10.5f %28.6f %10.1e\n", time, integrator.state().q(0), integrator.state().s(0),
                    energy.state_dissipation, energy.state_error);
    }
}
