/// @file
/// Comparison of Floquet exponents, which are known modulo i omega, for the tests.
#pragma once

#include "solvers/periodic/floquet.hpp"
#include "tests/support/second_order.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace cardan::testing {

/// The undeformed machine as a periodic state.
inline solvers::PeriodicSteadyState turning_undeflected(const System& system, int spin, double Omega) {
    solvers::PeriodicSteadyState state;
    state.converged = true;
    state.rotor_speed = Omega;
    state.spin = spin;
    state.coefficients = Matrix::Zero(system.model.size(), 1);
    state.state_coefficients = system.forces.states().initial();
    return state;
}

/// Exponents of a result with their conjugates.
inline std::vector<Complex> exponents(const solvers::Floquet& result) {
    std::vector<Complex> all;
    for (const solvers::FloquetMode& mode : result.modes) {
        all.push_back(mode.exponent);
        if (mode.kind == solvers::FloquetKind::oscillation) all.push_back(std::conj(mode.exponent));
    }
    return all;
}

/// |a - b| modulo i omega.
inline double distance(Complex a, Complex b, double omega) {
    const Complex d = a - b;
    return std::abs(Complex(d.real(), std::remainder(d.imag(), omega)));
}

/// From the nearest of a list.
inline double distance(Complex one, const std::vector<Complex>& list, double omega) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Complex other : list) nearest = std::min(nearest, distance(one, other, omega));
    return nearest;
}

/// Largest of any exponent of one list from the nearest of the other, both ways.
inline double distance(const std::vector<Complex>& a, const std::vector<Complex>& b, double omega) {
    double largest = 0;
    for (const Complex one : a) largest = std::max(largest, distance(one, b, omega));
    for (const Complex one : b) largest = std::max(largest, distance(one, a, omega));
    return largest;
}

}  // namespace cardan::testing
