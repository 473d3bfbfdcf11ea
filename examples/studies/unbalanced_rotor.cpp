// The whirl of an unbalanced disc over its speed, on supports alike in x and y and on unequal ones: there it whirls
// backward between the two critical speeds.
// Reference: closed form in fixed axes, x + i y = forward exp(i Omega t) + backward exp(-i Omega t),
//     (k_x - m Omega^2 + i c Omega) X = m e Omega^2,   (k_y - m Omega^2 + i c Omega) Y = -i m e Omega^2.   [Jeffcott
//     1919]
// Picture: unbalanced_rotor.svg.
#include "elements/machine_elements/joints.hpp"
#include "examples/studies/study.hpp"
#include "solvers/periodic/steady_state.hpp"
#include "solvers/pictures/stack.hpp"

using namespace cardan;

namespace {

constexpr double mass = 10, kx = 1e6, damping = 60, unbalance = 1e-3;  // kg, N/m, N s/m, kg m

System rotor(double ky) {
    Tree tree;
    ForceSet forces;
    const JointedFrame x = add_joint(tree, Tree::base(), JointKind::prismatic, Axis::x, "x", {"rotor"});
    const JointedFrame y = add_joint(tree, x.frame, JointKind::prismatic, Axis::y, "y", {"rotor"});
    const JointedFrame spin = add_joint(tree, y.frame, JointKind::revolute, Axis::z, "spin", {"rotor"});
    tree.weld(spin.frame, {mass, {unbalance / mass, 0, 0}, Mat3::Identity()});
    forces.add_spring("x", x.body, kx, damping);
    forces.add_spring("y", y.body, ky, damping);
    return {tree, forces};
}

struct Whirl {
    double forward, backward;  // m
    Whirl(Complex X, Complex Y)
        : forward(std::abs(X + Complex(0, 1) * Y) / 2), backward(std::abs(X - Complex(0, 1) * Y) / 2) {}
};

Whirl whirl(const System& system, double speed) {
    const solvers::PeriodicSteadyState state =
        solvers::harmonic_balance(system, system.model.index("spin"), {.rotor_speed = speed, .harmonics = 2});
    require_result(state);
    // x = Re(X exp(i Omega t)), from the cosine and the sine of the first harmonic.
    const auto phasor = [&](const char* name) {
        const int i = system.model.index(name);
        return Complex(state.coefficients(i, 1), -state.coefficients(i, 2));
    };
    return {phasor("x"), phasor("y")};
}

Whirl closed_form(double ky, double speed) {
    const double force = unbalance * speed * speed;
    const auto stiffness = [&](double k) { return Complex(k - mass * speed * speed, damping * speed); };
    return {force / stiffness(kx), Complex(0, -force) / stiffness(ky)};
}

}  // namespace

int main(int argc, char** argv) {
    program::Study study("unbalanced_rotor", "Whirl of an unbalanced disc on equal and unequal supports.");
    double ratio = 1.5;
    study.line.add_option("--ratio", ratio, "of the stiffness in y to that in x, unequal supports").positive();
    return study.run(argc, argv, [&] {
        const System equal = rotor(kx), unequal = rotor(ratio * kx);
        solvers::StackCurve alike{"equal supports"}, forward{"unequal: forward"}, backward{"unequal: backward"};
        for (int speed = 200; speed <= 500; ++speed) {
            const Whirl on_equal = whirl(equal, speed), on_unequal = whirl(unequal, speed);
            for (solvers::StackCurve* curve : {&alike, &forward, &backward}) curve->x.push_back(speed);
            alike.y.push_back(1e3 * on_equal.forward);
            forward.y.push_back(1e3 * on_unequal.forward);
            backward.y.push_back(1e3 * on_unequal.backward);
        }
        program::compare_with("closed form");
        for (const double speed : {250.0, 316.0, 360.0, 500.0}) {
            const Whirl one = whirl(equal, speed), exact = closed_form(kx, speed);
            const Whirl other = whirl(unequal, speed), exact_other = closed_form(ratio * kx, speed);
            program::compare(text("at ", speed, " rad/s: equal, mm"), 1e3 * one.forward, 1e3 * exact.forward, 8);
            program::compare("  unequal: forward, mm", 1e3 * other.forward, 1e3 * exact_other.forward, 8);
            program::compare("  backward, mm", 1e3 * other.backward, 1e3 * exact_other.backward, 8);
        }
        const double critical_x = std::sqrt(kx / mass), critical_y = std::sqrt(ratio * kx / mass);
        solvers::draw({.title = text("Unbalanced disc, supports alike and with k_y = ", ratio, " k_x"),
                       .x_label = "speed, rad/s",
                       .x_low = 200,
                       .x_high = 500,
                       .panels = {{"radius of the whirl, mm", {alike, forward, backward}, true}},
                       .marks = {{critical_x, "critical in x"}, {critical_y, "critical in y"}}},
                      study.picture);
    });
}
