/// @file
/// Forces, rates of states and their derivatives at a state.
#pragma once

#include "mbs/system/system.hpp"
#include "tests/support/allocations.hpp"

namespace cardan::testing {

struct Evaluated {
    Vector Q, f;
    ForceDerivatives by;
};
inline Evaluated evaluated(const System& system, const State& state) {
    Workspace workspace(system.model);
    const StateView at(state, kinematics(system.model, state.q, workspace));
    Evaluated out{Vector(state.q.size()), Vector(state.s.size()), {}};
    system.forces.generalised_forces(at, out.Q, out.f);
    system.forces.derivatives(at, out.by);
    return out;
}

/// Allocations of a second evaluation, derivatives included.
inline std::size_t allocations_of_evaluation(const System& system, const State& state) {
    Workspace workspace(system.model);
    const StateView at(state, kinematics(system.model, state.q, workspace));
    Evaluated out{Vector(state.q.size()), Vector(state.s.size()), {}};
    const auto evaluate = [&] {
        system.forces.generalised_forces(at, out.Q, out.f);
        system.forces.derivatives(at, out.by);
    };
    evaluate();
    return allocations(evaluate);
}

}  // namespace cardan::testing
