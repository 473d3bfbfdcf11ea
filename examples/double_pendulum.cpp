// A double pendulum: metric g, Christoffel symbols Gamma and forces Q of its equations of motion
//     g_ab q''^b + Gamma_abc q'^b q'^c = Q_a
// beside the formulas of the textbook, and the accelerations q''.
#include <cardan/elements/machine_elements/joints.hpp>
#include <cardan/mbs/base/units.hpp>
#include <cardan/mbs/kernels/christoffel.hpp>
#include <cardan/mbs/kernels/dynamics.hpp>
#include <cardan/mbs/system/system.hpp>

#include <cstdio>

int main() {
    using namespace cardan;
    constexpr double m1 = 2, m2 = 1, l1 = 1, l2 = 0.5, gravity = units::standard_gravity;  // kg, m, m/s^2

    // Point masses at the ends of rods that hang along -z and turn about y.
    Tree tree;
    const JointedFrame upper = add_joint(tree, Tree::base(), JointKind::revolute, Axis::y, "upper", {"pendulum"});
    const FrameId elbow = tree.add_frame(upper.frame, Placement::translation({0, 0, -l1}), "elbow");
    const JointedFrame lower = add_joint(tree, elbow, JointKind::revolute, Axis::y, "lower", {"pendulum"});
    const FrameId end = tree.add_frame(lower.frame, Placement::translation({0, 0, -l2}), "end");
    tree.weld(elbow, {.mass = m1});
    tree.weld(end, {.mass = m2});
    ForceSet forces;
    forces.set_gravity({0, 0, -gravity});
    const System system(tree, forces);

    // At angles q (the second one counted from the first) that change at the rates qd.
    const Vector q{{0.5, 0.8}}, qd{{1.0, -2.0}};  // rad, rad/s
    Workspace workspace(system.model);
    const Kinematics kin = kinematics(system.model, q, workspace);
    Matrix g(2, 2);
    metric(kin, g);
    Christoffel gamma(system.model);
    christoffel_first_kind(kin, gamma);
    Vector Q(2), qdd(2), drive_forces(2);
    system.forces.generalised_forces({{.q = q, .qd = qd}, kin}, Q);
    ForwardDynamics(system.model).solve(kin, qd, Q, qdd, drive_forces);

    const double c = std::cos(q(1)), s = std::sin(q(1)), fall = m2 * gravity * l2 * std::sin(q(0) + q(1));
    const auto row = [](const char* what, double computed, double formula, const char* unit) {
        std::printf("%-10s %12.6f %12.6f  %s\n", what, computed, formula, unit);
    };
    std::printf("              computed      formula\n");
    row("g_11", g(0, 0), (m1 + m2) * l1 * l1 + m2 * l2 * (l2 + 2 * l1 * c), "kg m^2");
    row("g_12", g(0, 1), m2 * l2 * (l2 + l1 * c), "kg m^2");
    row("g_22", g(1, 1), m2 * l2 * l2, "kg m^2");
    row("Gamma_112", gamma(0, 0, 1), -m2 * l1 * l2 * s, "kg m^2");
    row("Gamma_122", gamma(0, 1, 1), -m2 * l1 * l2 * s, "kg m^2");
    row("Gamma_211", gamma(1, 0, 0), m2 * l1 * l2 * s, "kg m^2");
    row("Q_1", Q(0), -(m1 + m2) * gravity * l1 * std::sin(q(0)) - fall, "N m");
    row("Q_2", Q(1), -fall, "N m");
    std::printf("qdd_1      %12.6f               rad/s^2\nqdd_2      %12.6f               rad/s^2\n", qdd(0), qdd(1));
}
