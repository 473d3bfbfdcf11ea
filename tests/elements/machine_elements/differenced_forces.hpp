/// @file
/// Derivatives of the forces of a system by central differences, beside those that it gives itself.
#pragma once

#include "mbs/system/system.hpp"

namespace cardan::testing {

struct DifferencedForces {
    Matrix by_q, by_qd;    ///< dQ/dq, dQ/dqd
    Vector slope;          ///< dV/dq
    Vector Q, Q_at_rest;   ///< at the state, and without rates
    ForceDerivatives own;  ///< the system's
};
inline DifferencedForces differenced(const System& system, const Vector& q, const Vector& qd) {
    constexpr double step = 1e-6;
    const Eigen::Index n = q.size();
    Workspace workspace(system.model);
    const auto Q = [&](const Vector& at, const Vector& rate) {
        Vector out(n);
        system.forces.generalised_forces({{.q = at, .qd = rate}, kinematics(system.model, at, workspace)}, out);
        return out;
    };
    const auto energy = [&](const Vector& at) {
        return system.forces.potential_energy({{.q = at, .qd = qd}, kinematics(system.model, at, workspace)});
    };
    DifferencedForces out{Matrix(n, n), Matrix(n, n), Vector(n), Q(q, qd), Q(q, Vector::Zero(n)), {}};
    for (Eigen::Index i = 0; i < n; ++i) {
        const Vector e = step * Vector::Unit(n, i);
        out.by_q.col(i) = (Q(q + e, qd) - Q(q - e, qd)) / (2 * step);
        out.by_qd.col(i) = (Q(q, qd + e) - Q(q, qd - e)) / (2 * step);
        out.slope(i) = (energy(q + e) - energy(q - e)) / (2 * step);
    }
    system.forces.derivatives({{.q = q, .qd = qd}, kinematics(system.model, q, workspace)}, out.own);
    return out;
}

}  // namespace cardan::testing
