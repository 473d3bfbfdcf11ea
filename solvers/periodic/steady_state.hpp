/// @file
/// Periodic steady state of a rotor that turns at constant speed: gravity, unbalance, two blades.
#pragma once

#include "mbs/model/rotor_map.hpp"
#include "solvers/equilibrium/steady_state.hpp"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace cardan::solvers {

struct PeriodicOptions {
    double rotor_speed = 0;  ///< rate of the spin coordinate, rad/s; not zero
    int harmonics = 8;       ///< number of harmonics of the revolution that are kept
    /// Harmonic balance: their number is doubled, up to four times as many, as long as
    /// PeriodicSteadyState::needs_more_harmonics.
    bool more_harmonics = false;
    /// Starting point, as PeriodicSteadyState::coefficients (with any number of harmonics; one column: constant);
    /// empty: zero. Rows of driven coordinates are their prescribed motion (constant pitch, cyclic pitch).
    Matrix start = {};
    /// Harmonics of the states at the start, as PeriodicSteadyState::state_coefficients; empty: as their table says.
    Matrix state_start = {};
    /// Residual / stiffness (rad, m; of states: over their scales), largest entry. If no step reduces it further, 1e-8
    /// counts as converged.
    double tolerance = 1e-10;
    int iterations = 40;
    /// Harmonic balance: azimuths per revolution at which the equations are evaluated; 0: 4 (harmonics + 1).
    int samples = 0;
    /// Harmonic balance: coordinates whose mean is fixed at that of `start` by a load, which is part of the result. For
    /// unrestrained coordinates, such as free yaw.
    std::vector<int> fixed_means = {};
    /// Harmonic balance: the blades. With two or more alike, steps cost a small part of Newton's for all coefficients;
    /// the steady state is the same to the tolerance. Null: Newton's steps for all coefficients.
    const RotorMap* rotor = nullptr;
    /// Shooting: steps per revolution (0: 8 harmonics, at least 64) and stages of Radau's method (order 2 s - 1).
    int steps = 0, stages = 5;
    /// Harmonic balance: asked at every azimuth at which the equations are evaluated; true: the result does not
    /// converge, and says so.
    std::function<bool()> cancelled = {};
};

/// A mean value that is fixed, and the load this requires.
struct FixedMean {
    int coordinate = -1;
    double load = 0;  ///< added to the generalised forces on it, N m or N
};

/// q(psi) = h0 + sum_j hc_j cos j psi + hs_j sin j psi, psi = rotor_speed * time the spin coordinate.
///                                                                                            [Lee et al. 2002, eq. 15]
struct [[nodiscard]] PeriodicSteadyState : Outcome {
    double rotor_speed = 0;  ///< rad/s
    int spin = -1;
    /// A row per coordinate of the model (rad or m; that of the spin is zero), columns h0, hc_1, hs_1, hc_2, ...
    Matrix coefficients;
    Matrix state_coefficients = {};  ///< a row per state, columns as of `coefficients`
    Vector inputs = {};              ///< held
    int iterations = 0;
    /// Largest residual / stiffness, rad or m: that of the balanced harmonics, or (shooting) the mismatch of positions
    /// and rates (divided by the rotor speed) after one revolution.
    double residual = 0;
    /// Largest residual / stiffness of the series at azimuths between those that were balanced: what the neglected
    /// harmonics would have to balance.
    double remainder = 0;
    std::vector<FixedMean> fixed_means;
    std::string note;  ///< what the equations leave undetermined and at which value it was kept; usually empty
    double state_remainder = 0;  ///< `remainder` of the states, over their scales
    /// Harmonic balance: the remainder is more than 1e-5, or that of the states, or 2e-3 where half as many harmonics
    /// left less than twice as much of the states: they follow kinks, as of airfoils' polars.
    bool needs_more_harmonics = false;
    Matrix multipliers = {};  ///< of the loops, Loops::equations(); a row each, as `coefficients`
    /// Turns of each coordinate in a revolution, with loops, beside its series: q = turns psi + ..., as that of a rod
    /// against its crank. Empty: none does.
    Vector turns = {};

    int harmonics() const { return static_cast<int>(coefficients.cols() / 2); }
    /// State of all coordinates with rates and accelerations, states and multipliers; time = psi / rotor_speed.
    DynamicState at(double psi) const;
    /// Largest amplitude sqrt(hc_j^2 + hs_j^2) of any coordinate in harmonic j (|h0| for j = 0), rad or m.
    double amplitude(int harmonic) const;
    /// Amplitude of the last two harmonics relative to the largest of all (mean excluded); 0 if nothing moves.
    double last_harmonics() const;
    /// A sentence if `needs_more_harmonics`, else nothing.
    std::string neglected_in_words() const;
};

/// Harmonic balance: makes the retained harmonics of g qdd + Gamma qd qd - Q on the free coordinates vanish, and those
/// of s' - f of the states. (Of states of kind `angle`, which grow for ever, all but the mean.) Newton's
/// method with line search; residual and exact Jacobian from the equations and their derivatives at equidistant
/// azimuths (alternating frequency and time). If the Jacobian is singular (an unrestrained mean) the minimum-norm step
/// is taken and `note` says so, unless the start already is a solution. With loops the multipliers are unknowns beside
/// the coordinates, and the retained harmonics of their equations vanish; the start need not be closed.
///                                                             [Cameron and Griffin 1989; Krack and Gross 2019]
///
/// Cost per iteration O(samples harmonics^2 n^2) and a linear system of n (2 harmonics + 1) rows. If `rotor` is given,
/// the Jacobian is the mean of that over the revolution in multi-blade coordinates as long as the residual falls well:
/// an iteration then costs a linear system of n complex rows for every harmonic that matters. Two alike blades leave
/// half of the coefficients: even harmonics of their sum, odd ones of their difference.
/// @throws InputError for options out of range; force elements must have the period of a revolution and are not checked
PeriodicSteadyState harmonic_balance(const System& system, int spin, const PeriodicOptions& options);

/// The periodic steady state by shooting: finds the free coordinates, rates and states at azimuth 0 that one revolution
/// reproduces, by Newton's method with the exact derivative of the integration (Radau IIA, equal steps), the monodromy
/// matrix. The harmonics are computed from the ends of the steps.
/// @throws InputError also for `fixed_means`, for loops, for states of kind `angle` and if there are fewer than 2
/// harmonics + 1 steps
PeriodicSteadyState shooting(const System& system, int spin, const PeriodicOptions& options);

/// Steady states at one rotor speed after another by harmonic balance, each started from the previous one. A speed that
/// fails is approached in up to 2^6 parts of the interval; if that fails too, the result is returned as it is, and the
/// next speed starts from the last one that converged.
/// @param options  its rotor speed is not used
std::vector<PeriodicSteadyState> periodic_sweep(const System& system, int spin, std::span<const double> rotor_speed,
                                                PeriodicOptions options = {});

}  // namespace cardan::solvers
