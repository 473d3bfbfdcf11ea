// Jeffcott's rotor: a disc in the middle of an elastic shaft. Damping of the shaft turns with it and drives the forward
// whirl above the speed sqrt(k/m)(1 + ce/ci), ci of the shaft, ce to the ground.
// Reference: closed form of the eigenvalues, with z = x + i y in fixed axes,
//     m z'' + (ce + ci) z' + (k - i ci Omega) z = 0.                                               [Smith 1933]
// Picture: jeffcott_rotor.svg.
#include "elements/machine_elements/bushing.hpp"
#include "elements/machine_elements/joints.hpp"
#include "examples/studies/study.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/pictures/stack.hpp"

using namespace cardan;

namespace {

constexpr double mass = 10, k = 1e6, outer = 60;  // kg, N/m, ce in N s/m

// In axes that turn with the shaft; the damper to the ground is a bearing without stiffness.
System rotor(double inner) {
    Tree tree;
    ForceSet forces;
    const JointedFrame spin = add_joint(tree, Tree::base(), JointKind::revolute, Axis::z, "spin", {"rotor"});
    const JointedFrame x = add_joint(tree, spin.frame, JointKind::prismatic, Axis::x, "x", {"rotor"});
    const JointedFrame y = add_joint(tree, x.frame, JointKind::prismatic, Axis::y, "y", {"rotor"});
    tree.weld(y.frame, {mass, Vec3::Zero(), Mat3::Identity()});
    forces.add_spring("shaft x", x.body, k, inner);
    forces.add_spring("shaft y", y.body, k, inner);
    add_bearing(forces,
                {"damper", Tree::base(), y.frame, {Eigen::Matrix2d::Zero(), outer * Eigen::Matrix2d::Identity()}});
    return {tree, forces};
}

struct Whirls {
    Complex forward, backward;  // eigenvalues, 1/s
};

Whirls whirls(const System& system, double speed) {
    const int spin = system.model.index("spin");
    const solvers::SteadyState state = solvers::steady_state(system, spin, {.rotor_speed = speed});
    require_result(state);
    Whirls out;
    const std::vector<int> unknowns = system.model.coordinates().free_without(spin);  // x, y
    for (const solvers::Mode& mode : solvers::modes(restrict_to(solvers::linearise(system, state.at), unknowns))) {
        // Seen from the shaft a whirl that is slower than the shaft turns backward.
        const bool turns_ahead = std::imag(std::conj(mode.shape(0)) * mode.shape(1)) < 0;
        const Complex seen = turns_ahead ? mode.eigenvalue : std::conj(mode.eigenvalue);
        const Complex fixed = seen + Complex(0, speed);
        (fixed.imag() > 0 ? out.forward : out.backward) = fixed;
    }
    return out;
}

Whirls closed_form(double inner, double speed) {
    const double c = outer + inner;
    const Complex root = std::sqrt(Complex(c * c - 4 * mass * k, 4 * mass * inner * speed));  // imaginary part > 0
    return {(-c + root) / (2 * mass), (-c - root) / (2 * mass)};
}

}  // namespace

int main(int argc, char** argv) {
    program::Study study("jeffcott_rotor", "Jeffcott's rotor with internal damping: growth of its whirls over speed.");
    double inner = 40;
    study.line.add_option("--internal-damping", inner, "ci, N s/m").positive();
    return study.run(argc, argv, [&] {
        const System system = rotor(inner);
        const double limit = std::sqrt(k / mass) * (1 + outer / inner);
        solvers::StackCurve forward{"forward"}, backward{"backward"};
        const int points = 120;
        for (int i = 1; i <= points; ++i) {
            const double speed = 1.2 * limit * i / points;
            const Whirls found = whirls(system, speed);
            for (solvers::StackCurve* curve : {&forward, &backward}) curve->x.push_back(speed);
            forward.y.push_back(found.forward.real());
            backward.y.push_back(found.backward.real());
        }
        program::compare_with("closed form");
        for (const double speed : {300.0, 700.0, 900.0}) {
            const Whirls found = whirls(system, speed), closed = closed_form(inner, speed);
            program::compare(text("at ", speed, " rad/s: forward, 1/s"), found.forward.real(), closed.forward.real(),
                             7);
            program::compare("  its frequency, rad/s", found.forward.imag(), closed.forward.imag(), 6);
            program::compare("  backward, 1/s", found.backward.real(), closed.backward.real(), 7);
            program::compare("  its frequency, rad/s", found.backward.imag(), closed.backward.imag(), 6);
        }
        // Growth is almost linear in the speed near the limit: one step of the secant rule.
        const double a = 0.999 * limit, b = 1.001 * limit;
        const double at_a = whirls(system, a).forward.real(), at_b = whirls(system, b).forward.real();
        program::compare("limit of stability, rad/s", a - at_a * (b - a) / (at_b - at_a), limit, 5);
        solvers::draw(
            {.title = text("Jeffcott's rotor: damping of the shaft ", inner, " N s/m, to the ground ", outer, " N s/m"),
             .x_label = "speed, rad/s",
             .x_high = 1.2 * limit,
             .panels = {{"growth rate, 1/s", {forward, backward}}},
             .marks = {{std::sqrt(k / mass), "critical speed"}, {limit, "limit"}}},
            study.picture);
    });
}
