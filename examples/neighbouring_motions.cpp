// How motions of a double pendulum that start side by side drift apart: P, the derivative of (q, q') at a time by that
// at the start, from exact derivatives of the accelerations. Beside it the difference of two motions, and Liouville's
// theorem: det P = det g(start) / det g(end), for two equal rods det g = (2 - cos^2 lower) m^2 l^4.
#include <cardan/elements/machine_elements/joints.hpp>
#include <cardan/mbs/base/error.hpp>
#include <cardan/mbs/base/units.hpp>
#include <cardan/mbs/kernels/dynamics.hpp>
#include <cardan/mbs/system/forward_derivatives.hpp>
#include <cardan/mbs/system/system.hpp>

#include <cstdio>
#include <iostream>

using namespace cardan;

int main() try {
    Tree tree;
    FrameId end = Tree::base();
    for (const char* name : {"upper", "lower"}) {
        const JointedFrame rod = add_joint(tree, end, JointKind::revolute, Axis::y, name, {"pendulum"});
        tree.weld(end = tree.add_frame(rod.frame, Placement::translation({0, 0, -1}), text(name, " end")), {.mass = 1});
    }
    ForceSet forces;
    forces.set_gravity({0, 0, -units::standard_gravity});
    const System system(tree, forces);
    Workspace workspace(system.model);
    ForwardDynamics dynamics(system.model);
    ForwardDynamicsDerivatives derivatives(system.model);
    Vector Q(2), qdd(2), drive_forces(2);
    ForceDerivatives by_q;
    const auto rates = [&](const Matrix& x) {  // the first column of x is (q, q'), the others are P
        const State at{.q = x.col(0).head(2), .qd = x.col(0).tail(2)};
        const Kinematics kin = kinematics(system.model, at.q, workspace);
        system.forces.generalised_forces({at, kin}, Q);
        system.forces.derivatives({at, kin}, by_q);
        dynamics.solve(kin, at.qd, Q, qdd, drive_forces);
        if (!derivatives.compute(kin, at.qd, qdd, &by_q)) throw NumericalError("the metric is not positive definite");
        const Matrix by_x =
            derivatives.dqdd_dq() * x.topRightCorner(2, 4) + derivatives.dqdd_dqd() * x.bottomRightCorner(2, 4);
        return (Matrix(4, 5) << at.qd, x.bottomRightCorner(2, 4), qdd, by_x).finished();
    };
    constexpr double h = 1e-3, lower = 0.5, apart = 1e-7;  // s, rad, of the upper angle
    Matrix first = (Matrix(4, 5) << Vector{{2, lower, 0, 0}}, Matrix::Identity(4, 4)).finished(), second = first;
    second(0, 0) += apart;
    std::printf("time, s   d lower / d upper   by two motions        det P   det g(start) / det g(end)\n");
    for (int step = 1; step <= 3000; ++step) {
        for (Matrix* x : {&first, &second}) {  // the classical Runge-Kutta method
            const Matrix a = rates(*x), b = rates(*x + h / 2 * a), c = rates(*x + h / 2 * b), d = rates(*x + h * c);
            *x += h / 6 * (a + 2 * b + 2 * c + d);
        }
        if (step % 1000 == 0)
            std::printf("%7.1f %19.6f %16.6f %12.8f %20.8f\n", h * step, first(1, 1),
                        (second(1, 0) - first(1, 0)) / apart, Matrix(first.rightCols(4)).determinant(),
                        (2 - std::pow(std::cos(lower), 2)) / (2 - std::pow(std::cos(first(1, 0)), 2)));
    }
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
