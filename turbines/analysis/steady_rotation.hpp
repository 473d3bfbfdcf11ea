/// @file
/// Steady rotation of a machine, periodic.
#pragma once

#include "solvers/periodic/steady_state.hpp"
#include "turbines/analysis/remark.hpp"
#include "turbines/model/assembly.hpp"

#include <functional>

namespace cardan::turbines {

struct SteadyRotationOptions {
    int harmonics = 8;  ///< of the revolution, at first
    /// Out of balance by less, residual over stiffness, rad or m, a state is taken as well, with a note: free yaw,
    /// which nothing holds, has hardly any equilibrium.
    double good = 1e-7;
    /// PeriodicOptions::start and state_start; with states more harmonics are taken where they are needed.
    Matrix start = {}, state_start = {};
    int azimuths = 0;                      ///< per revolution, at least: MachineAir::min_azimuths()
    std::function<bool()> cancelled = {};  ///< asked often; true: NumericalError
};

/// Steady rotation by harmonic balance. What the solver notes is reported.
/// @param rotor_speed  rad/s, not zero
/// @throws NumericalError if there is none
solvers::PeriodicSteadyState steady_rotation(const Turbine& turbine, double rotor_speed,
                                             const SteadyRotationOptions& options = {}, const Report& report = {});

/// State at rest in equilibrium, the rotor held.
/// @param azimuth  of blade 1, rad
/// @param states   to start from; empty: as their table says
/// @throws NumericalError if there is no equilibrium
DynamicState standstill(const Turbine& turbine, double azimuth, const Vector& states = {});

}  // namespace cardan::turbines
