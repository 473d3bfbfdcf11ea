// A flywheel on one joint about z under forces of one's choice, and the derivatives of such forces.
#pragma once

#include "mbs/system/system.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/tree_tools.hpp"

#include <functional>

namespace cardan::testing {

/// A flywheel of inertia J under a constant moment and some force elements.
struct Shaft {
    double J = 2, moment = 0;

    System system(const std::function<std::vector<ForceElement>(BodyId)>& users) const {
        Tree tree;
        ForceSet forces;
        const Link wheel = add_joint(tree, {.name = "wheel", .inertia = {1, Vec3::Zero(), Vec3(J, J, J).asDiagonal()}});
        for (ForceElement& user : users(wheel.body)) forces.add_element(std::move(user));
        if (moment != 0)
            forces.add_wrench({"moment", wheel.axes, {Vec3::Zero(), moment * Vec3::UnitZ()}, WrenchAxes::base});
        return {tree, forces};
    }
};

inline Vector one(double value) {
    return Vector::Constant(1, value);
}

/// Force, stiffness and damping of a system with one coordinate.
struct OneForce {
    double Q, by_q, by_qd, energy;
};
inline OneForce evaluate(const System& system, double time, double q, double qd) {
    Workspace workspace(system.model);
    const Vector x = one(q), v = one(qd);
    const Kinematics kin = kinematics(system.model, x, workspace);
    Vector Q(1);
    system.forces.generalised_forces({{.time = time, .q = x, .qd = v}, kin}, Q);
    ForceDerivatives d;
    system.forces.derivatives({{.time = time, .q = x, .qd = v}, kin}, d);
    return {Q(0), -(d.elastic + d.loads + d.gravity)(0), -d.damping(0),
            system.forces.potential_energy({{.time = time, .q = x, .qd = v}, kin})};
}

/// Derivative of f at x by the complex step.
template <class F>
double complex_slope(const F& f, double x) {
    constexpr double h = 1e-30;
    return f(Complex(x, h)).imag() / h;
}

/// Something that happens at a time and changes forces.
inline solvers::Event at_time(double time, std::function<void(double)> action) {
    solvers::Event event;
    event.name = "at a time";
    event.direction = 1;
    event.function = [time](const StateView& in) { return in.time - time; };
    event.action = [action = std::move(action)](solvers::Integrator& integrator) {
        action(integrator.time());
        return solvers::AfterEvent::restart;
    };
    return event;
}

/// An explicit method with tight tolerances: no iteration, no Jacobian takes part in the result.
inline solvers::IntegrationOptions accurate(double relative = 1e-9) {
    solvers::IntegrationOptions options;
    options.method = solvers::Method::erk;
    options.tolerances = {relative, relative, relative, relative, relative};
    return options;
}

}  // namespace cardan::testing
