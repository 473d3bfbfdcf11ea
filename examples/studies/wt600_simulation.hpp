/// @file
/// Common parts of the studies of the 600 kW machine in time: its elements, and how a run starts.
#pragma once

#include "mbs/base/outcome.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "turbines/reference_turbines/wt600_operation.hpp"

namespace cardan::program {

/// The kind of elements with which the paper is reproduced: few coordinates, and none as stiff as an extension.
inline turbines::AssemblyOptions elements_of_paper(int blade_elements, int tower_elements) {
    turbines::AssemblyOptions options = turbines::wt600_paper_assembly();
    options.blade_elements = blade_elements;
    options.tower_elements = tower_elements;
    return options;
}

/// Constant state under some forces; the spin is held at its azimuth or turns steadily.
/// @param initial  where the iteration starts and driven coordinates are held; empty: zero
inline Vector steady_position(const turbines::Turbine& turbine, const ForceSet& forces, double speed, double azimuth,
                              const Vector& initial = {}) {
    const System system(turbine.tree(), forces);
    solvers::SteadyOptions options;
    options.rotor_speed = speed;
    options.azimuth = azimuth;
    options.initial = initial;
    const solvers::SteadyState state = solvers::steady_state(system, turbine.rotor().spin, options);
    require_result(state, "start of the simulation");
    return state.at.q;
}

/// State at time zero.
struct Start {
    Vector q, qd;
};

/// State at rest under gravity, blade 1 up.
/// @param driven  where the driven coordinates are; empty: at zero
inline Start standing_start(const turbines::Wt600Operation& machine, const Vector& driven = {}) {
    const Vector q = steady_position(machine.turbine, machine.turbine.forces(), 0, 0, driven);
    return {q, Vector::Zero(q.size())};
}

/// State in rotation, blade 1 up: the steady state without gravity and tower shadow, and what gravity bends the
/// standing machine, as the azimuth changes it. This is periodic but for the square of rotor speed over natural
/// frequencies.
/// @param calm  the same machine without gravity and tower shadow
inline Start rotating_start(const turbines::Wt600Operation& machine, const turbines::Wt600Operation& calm,
                            double speed) {
    constexpr double h = 1e-3;
    const auto sag = [&](double azimuth) {
        return Vector(steady_position(machine.turbine, machine.turbine.forces(), 0, azimuth) -
                      steady_position(calm.turbine, calm.turbine.forces(), 0, azimuth));
    };
    const Vector rotating = steady_position(calm.turbine, calm.turbine.forces(), speed, 0);
    Start start{rotating + sag(0), speed * (sag(h) - sag(-h)) / (2 * h)};
    start.qd(machine.turbine.rotor().spin) = speed;
    return start;
}

}  // namespace cardan::program
