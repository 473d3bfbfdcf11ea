#include "turbines/analysis/steady_rotation.hpp"

#include "mbs/base/outcome.hpp"

#include <utility>

namespace cardan::turbines {

solvers::PeriodicSteadyState steady_rotation(const Turbine& turbine, double rotor_speed,
                                             const SteadyRotationOptions& options, const Report& report) {
    solvers::PeriodicOptions periodic;
    periodic.rotor_speed = rotor_speed;
    periodic.harmonics = options.harmonics;
    periodic.rotor = &turbine.rotor();
    periodic.cancelled = options.cancelled;
    periodic.start = options.start;
    periodic.state_start = options.state_start;
    periodic.more_harmonics = options.state_start.size() > 0;
    if (options.azimuths > 4 * (options.harmonics + 1)) periodic.samples = options.azimuths;
    const auto solve = [&] { return solvers::harmonic_balance(turbine.system(), turbine.rotor().spin, periodic); };
    solvers::PeriodicSteadyState state = solve();
    if (!state.converged && state.residual < options.good) {
        report_remark(report, {.text = text("the steady state is out of balance by ",
                                            digits(state.residual, std::chars_format::scientific, 1),
                                            " (residual over stiffness, rad or m)")});
        periodic.tolerance = options.good;
        periodic.start = state.coefficients;
        periodic.state_start = state.state_coefficients;
        state = solve();
    }
    require_result(state, "steady rotation");
    if (!state.note.empty()) report_remark(report, {.text = text("steady state: ", state.note)});
    return state;
}

DynamicState standstill(const Turbine& turbine, double azimuth, const Vector& states) {
    solvers::SteadyOptions options;
    options.azimuth = azimuth;
    options.states = states;
    const solvers::SteadyState state = solvers::steady_state(turbine.system(), turbine.rotor().spin, options);
    require_result(state);
    return state.at;
}

}  // namespace cardan::turbines
