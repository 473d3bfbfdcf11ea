/// @file
/// Equilibrium at standstill and in steady rotation.
#pragma once

#include "mbs/rotor_map.hpp"
#include "mbs/system.hpp"

#include <string>

namespace cardan::solvers {

/// Position, velocity and acceleration of all coordinates at a time.
struct OperatingPoint {
    Vector q, qd, qdd;
    double time = 0;
};

struct SteadyOptions {
    double rotor_speed = 0;    ///< rate of the spin coordinate, rad/s
    double azimuth = 0;        ///< its position, rad
    Vector initial = {};       ///< starting point of the iteration; empty: zero
    double tolerance = 1e-11;  ///< residual over stiffness (rad, m), largest entry
    int iterations = 60;
};

/// Result of steady_state(); `at` is the last iterate also if it did not converge.
struct [[nodiscard]] SteadyState {
    bool converged = false;
    OperatingPoint at;
    double residual = 0;  ///< largest residual over stiffness, rad or m
    int iterations = 0;
    std::string message;  ///< why it did not converge and what to do, empty if it did
};

/// Constant free coordinates while only the spin coordinate moves: r(q) = Gamma_abc qd^b qd^c - Q_a = 0 on the free
/// coordinates, the spin being prescribed. KINSOL's Newton iteration with line search and the exact Jacobian.
///
/// With rotation the result is checked at another azimuth: where gravity, an unbalance or two blades make the steady
/// state periodic, there is no such constant and NumericalError says so.
/// @param spin  index of the spin coordinate, -1: none (then rotor_speed must be zero)
SteadyState steady_state(const System& system, int spin, const SteadyOptions& options = {});

}  // namespace cardan::solvers
