/// @file
/// Periodic steady state of a rotor that turns at constant speed: gravity, unbalance, two blades.
#pragma once

#include "solvers/equilibrium/steady_state.hpp"

#include <span>
#include <string>
#include <vector>

namespace cardan::solvers {

struct PeriodicOptions {
    double rotor_speed = 0;  ///< rate of the spin coordinate, rad/s; not zero
    int harmonics = 8;       ///< of the revolution that are kept
    /// Where the iteration begins, as PeriodicSteadyState::coefficients (with any number of harmonics; one column:
    /// constant); empty: zero. Rows of driven coordinates are their prescribed motion (constant pitch, cyclic pitch).
    Matrix start = {};
    /// Residual over stiffness (rad, m), largest entry. Where no step makes it smaller 1e-8 is taken for converged.
    double tolerance = 1e-10;
    int iterations = 40;
    /// Harmonic balance: azimuths per revolution at which the equations are evaluated; 0: 4 (harmonics + 1).
    int samples = 0;
    /// Harmonic balance: coordinates whose mean is held at that of `start`, by a load that comes out. For coordinates
    /// that nothing holds, such as a free yaw.
    std::vector<int> held = {};
    /// Shooting: steps per revolution (0: 8 harmonics, 64 at least) and stages of Radau's method (order 2 s - 1).
    int steps = 0, stages = 5;
};

/// A mean value that is held, and the load that this takes.
struct HeldMean {
    int coordinate = -1;
    double load = 0;  ///< added to the generalised forces on it, N m or N
};

/// q(psi) = h0 + sum_j hc_j cos j psi + hs_j sin j psi, psi = rotor_speed * time the spin coordinate.
///                                                                                            [Lee et al. 2002, eq. 15]
struct [[nodiscard]] PeriodicSteadyState {
    bool converged = false;
    double rotor_speed = 0;  ///< rad/s
    int spin = -1;
    /// A row per coordinate of the model (rad or m; that of the spin is zero), columns h0, hc_1, hs_1, hc_2, ...
    Matrix coefficients;
    int iterations = 0;
    /// Largest residual over stiffness, rad or m: of the balanced harmonics, or by how much positions and rates (over
    /// the rotor speed) after one revolution miss those at its beginning.
    double residual = 0;
    /// Largest residual over stiffness of the series, at azimuths between those that were balanced: what the harmonics
    /// left out would have to carry.
    double remainder = 0;
    std::vector<HeldMean> held;
    std::string message;  ///< why it did not converge and what to do, empty if it did
    std::string note;     ///< what the equations leave open and where it was kept; mostly empty

    int harmonics() const { return static_cast<int>(coefficients.cols() / 2); }
    /// All coordinates with rates and accelerations; time = psi / rotor_speed.
    OperatingPoint at(double psi) const;
    /// Largest amplitude sqrt(hc_j^2 + hs_j^2) of any coordinate in harmonic j (|h0| for j = 0), rad or m.
    double amplitude(int harmonic) const;
    /// That of the last two harmonics over the largest of all (mean left out); 0 if nothing moves.
    double last_harmonics() const;
};

/// Harmonic balance: the harmonics up to the last one of g qdd + Gamma qd qd - Q on the free coordinates vanish.
/// Newton's method with line search; residual and exact Jacobian from the equations and their derivatives at
/// equidistant azimuths (alternating frequency and time). Where the Jacobian is singular (a mean that nothing holds)
/// the shortest step is taken and `note` says so, unless the start is a solution already.
///                                                             [Cameron and Griffin 1989; Krack and Gross 2019]
///
/// Cost per iteration O(samples harmonics^2 n^2) and a linear system of n (2 harmonics + 1) rows.
/// @throws InputError for options out of range; user forces must have the period of a revolution and are not checked
PeriodicSteadyState harmonic_balance(const System& system, int spin, const PeriodicOptions& options);

/// The same by shooting: the free coordinates and rates at azimuth 0 from which one revolution leads back, by Newton's
/// method with the exact derivative of the integration (Radau IIA, equal steps), the monodromy matrix. The harmonics
/// come from the ends of the steps.
/// @throws InputError also for `held` and if there are fewer than 2 harmonics + 1 steps
PeriodicSteadyState shooting(const System& system, int spin, const PeriodicOptions& options);

/// Steady states at one rotor speed after the other by harmonic balance, each begun from the one before. A speed that
/// fails is approached in up to 2^6 parts of the interval; what fails then too is returned as it is, and the next one
/// begins from the last that converged.
/// @param options  its rotor speed is not used
std::vector<PeriodicSteadyState> periodic_sweep(const System& system, int spin, std::span<const double> rotor_speed,
                                                PeriodicOptions options = {});

}  // namespace cardan::solvers
