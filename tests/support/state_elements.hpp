/// @file
/// Forces, rates of states and their derivatives at a state.
#pragma once

#include "mbs/system/system.hpp"
#include "tests/support/allocations.hpp"

namespace cardan::testing {

struct Evaluated {
    Vector Q, f;
    ForceDerivatives forces;
    StateDerivatives states;
};
inline Evaluated evaluated(const System& system, const Vector& q, const Vector& qd, const Vector& s, const Vector& u,
                           double time = 0) {
    Workspace workspace(system.model);
    const Kinematics kin = kinematics(system.model, q, workspace);
    const ForceInput at{time, q, qd, kin, s, u};
    Evaluated out{Vector(q.size()), Vector(s.size()), {}, {}};
    system.forces.evaluate(at, out.Q, out.f);
    system.forces.derivatives(at, out.forces, out.states);
    return out;
}

/// Allocations of a second evaluation, derivatives included.
inline std::size_t allocations_of_evaluation(const System& system, const Vector& q, const Vector& qd, const Vector& s,
                                             const Vector& u) {
    Workspace workspace(system.model);
    const Kinematics kin = kinematics(system.model, q, workspace);
    const ForceInput at{0, q, qd, kin, s, u};
    Evaluated out{Vector(q.size()), Vector(s.size()), {}, {}};
    const auto evaluate = [&] {
        system.forces.evaluate(at, out.Q, out.f);
        system.forces.derivatives(at, out.forces, out.states);
    };
    evaluate();
    return allocations(evaluate);
}

}  // namespace cardan::testing
