/// @file
/// Comparison of Floquet exponents, which are known modulo i omega, for the tests.
#pragma once

#include "mbs/base/decompositions.hpp"
#include "solvers/periodic/floquet.hpp"
#include "tests/support/simulation.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace cardan::testing {

/// The undeformed machine as a periodic state.
inline solvers::PeriodicSteadyState at_rest(const System& system, int spin, double Omega) {
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

/// Exponents of M q'' + C q' + K q = 0.
inline std::vector<Complex> eigenvalues(const Matrix& M, const Matrix& C, const Matrix& K) {
    const Eigen::Index n = M.rows();
    Matrix S = Matrix::Zero(2 * n, 2 * n);
    S.topRightCorner(n, n).setIdentity();
    S.bottomLeftCorner(n, n) = -M.inverse() * K;
    S.bottomRightCorner(n, n) = -M.inverse() * C;
    const Eigen::VectorXcd lambda = Eigen::EigenSolver<Matrix>(S, false).eigenvalues();
    return {lambda.begin(), lambda.end()};
}

/// Exponents of M(psi) q'' + C(psi) q' + K(psi) q = 0 written by hand, by the classical Runge-Kutta method.
using Coefficients = std::function<void(double psi, Matrix& M, Matrix& C, Matrix& K)>;
inline std::vector<Complex> exponents(const Coefficients& at, Eigen::Index n, double Omega, int steps) {
    Matrix Phi(2 * n, 2 * n), M(n, n), C(n, n), K(n, n);
    for (Eigen::Index j = 0; j < 2 * n; ++j)
        Phi.col(j) = runge_kutta(
            Vector::Unit(2 * n, j),
            [&](double t, const Vector& x) {
                at(Omega * t, M, C, K);
                Vector rate(2 * n);
                rate << x.tail(n), M.partialPivLu().solve(-C * x.tail(n) - K * x.head(n));
                return rate;
            },
            0, 2 * pi / Omega, steps);
    std::vector<Complex> all;
    const Eigen::VectorXcd multipliers = Eigen::EigenSolver<Matrix>(Phi, false).eigenvalues();
    for (const Complex mu : multipliers) all.push_back(std::log(mu) * Omega / (2 * pi));
    return all;
}

}  // namespace cardan::testing
