/// @file
/// Steady rotation of a machine, as programs look for it.
#pragma once

#include "mbs/base/outcome.hpp"
#include "solvers/periodic/steady_state.hpp"
#include "turbines/model/assembly.hpp"

#include <cstdio>

namespace cardan::program {

/// By harmonic balance. Free yaw, which nothing holds, has hardly any equilibrium: a state that is out of balance by
/// less than `good` (residual over stiffness, rad or m) is taken as well. That, and the note of the solver, are
/// printed.
/// @param rotor_speed  rad/s, not zero
/// @throws NumericalError if there is none
inline solvers::PeriodicSteadyState steady_rotation(const turbines::Turbine& turbine, double rotor_speed, int harmonics,
                                                    double good = 1e-7) {
    solvers::PeriodicOptions options;
    options.rotor_speed = rotor_speed;
    options.harmonics = harmonics;
    options.rotor = &turbine.rotor();
    const auto solve = [&] { return solvers::harmonic_balance(turbine.system(), turbine.rotor().spin, options); };
    solvers::PeriodicSteadyState state = solve();
    if (!state.converged && state.residual < good) {
        std::printf("note: the steady state is out of balance by %.1e (residual over stiffness, rad or m)\n",
                    state.residual);
        options.tolerance = good;
        options.start = state.coefficients;
        state = solve();
    }
    require_result(state, "steady rotation");
    if (!state.note.empty()) std::printf("note: steady state: %s\n", state.note.c_str());
    return state;
}

}  // namespace cardan::program
