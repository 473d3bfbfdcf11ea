/// @file
/// Statics under loads that grow in steps: dead and follower loads, at standstill or in steady rotation.
#pragma once

#include "solvers/equilibrium/steady_state.hpp"

#include <limits>
#include <optional>
#include <vector>

namespace cardan::solvers {

/// The system with its loads (wrenches, force elements and, if wanted, gravity) multiplied by a factor; see
/// Forces::with_load_factor().
System under_load(const System& system, double factor, bool gravity);

struct EquilibriumPathOptions {
    /// Load factors to be reached, strictly increasing; the path starts at the first one, solved from `state.initial`.
    /// Empty: 0, 1/steps, 2/steps, ..., 1.
    std::vector<double> factors = {};
    int steps = 10;               ///< number of equal steps from 0 to 1 if `factors` is empty
    double smallest_step = 1e-4;  ///< a step that failed is halved, but not below this change of the load factor
    bool gravity = true;          ///< gravity is one of the loads; otherwise it acts in full from the start
    int spin = -1;                ///< index of the spin coordinate; -1: none
    SteadyOptions state = {};     ///< for every state: rotor speed (constant), azimuth, start, tolerance, iterations
    /// Largest change of any coordinate (rad or m) between two neighbouring states; a larger one counts as a step that
    /// failed. It keeps the path from jumping to a distant equilibrium (snap-through).
    double largest_change = std::numeric_limits<double>::infinity();
    /// Width in load factor to which the first loss of stability is narrowed by bisection; 0: not narrowed.
    double stability_tolerance = 0;
};

/// One equilibrium on the path.
struct EquilibriumPathPoint {
    double factor = 0;    ///< on the loads
    DynamicState at;      ///< q, and with rotation the rate of the spin coordinate
    int iterations = 0;   ///< of Newton's method in the step that led here
    double residual = 0;  ///< SteadyState::residual
    /// Number of negative pivots of the tangent stiffness dr/dq on the unknowns: of its symmetric part, counted as
    /// negative eigenvalues (Sylvester). 0: statically stable. Under loads without potential (follower forces, moments
    /// about fixed axes) it proves stability against divergence only; for flutter see load_stability().
    int negative_pivots = 0;
};

/// Factor at which the number of negative pivots first differs from that at the start of the path.
struct StabilityChange {
    double before = 0;  ///< largest load factor with the old number
    double after = 0;   ///< smallest one with the new number
    int negative_pivots_before = 0, negative_pivots_after = 0;
    double factor() const { return (before + after) / 2; }
};

/// Result of equilibrium_path(): every state that converged, in the order of load factors. The path itself did if the
/// last factor was reached; otherwise the message says why it ended early, at which factor and what to do.
struct [[nodiscard]] EquilibriumPath : Outcome {
    std::vector<EquilibriumPathPoint>
        points;  ///< requested factors and those of halved steps; the last one is always kept
    std::optional<StabilityChange> stability_change;
    int failed_steps = 0;  ///< steps that were tried and halved
};

/// Equilibria r(q) = Gamma_abc qd^b qd^c - Q_a(q, factor) = 0 while the loads grow. Every step starts from the last
/// state, extrapolated along the secant of the last two, and is solved by steady_state(). An unstable equilibrium
/// (beyond a bifurcation of a perfect structure) is followed like any other: see `negative_pivots`.
///
/// Load control: beyond a limit point, where the load cannot grow further, the path ends; load_curve() goes on. With
/// loops the stiffness is that of the closed machine.
/// @throws InputError: factors not finite or not strictly increasing, steps < 1, smallest_step or largest_change not
/// positive, a negative tolerance; and as steady_state().
EquilibriumPath equilibrium_path(const System& system, const EquilibriumPathOptions& options = {});

/// Number of negative eigenvalues of the symmetric part of a stiffness matrix, scaled to unit diagonal first; those
/// within 1e-12 of the largest count as zero.
int negative_pivots(const Matrix& stiffness);

}  // namespace cardan::solvers
