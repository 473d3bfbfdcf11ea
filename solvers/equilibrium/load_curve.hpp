/// @file
/// Equilibria along a curve on which the load may turn: through limit points, where a structure snaps through.
#pragma once

#include "solvers/equilibrium/equilibrium_path.hpp"

#include <string>
#include <vector>

namespace cardan::solvers {

struct LoadCurveOptions {
    double from = 0, to = 1;   ///< load factors: where it begins, and where it ends, when it first gets beyond
    double first_step = 0.02;  ///< arc length, see below; grows and shrinks with the number of iterations
    double largest_step = 0.1, smallest_step = 1e-7;
    int points = 1000;         ///< at most
    bool gravity = true;       ///< gravity is one of the loads; otherwise it acts in full from the start
    int spin = -1;             ///< index of the spin coordinate; -1: none
    SteadyOptions state = {};  ///< of the first point; rotor speed and azimuth of all
};

/// One equilibrium on the curve.
struct LoadCurvePoint {
    double factor = 0;
    DynamicState at;
    int negative_pivots = 0;  ///< as EquilibriumPathPoint::negative_pivots
    double slope = 0;         ///< d factor / d arc length; it changes its sign at limit points
};

/// Result of load_curve(). It converged if it got beyond the last factor.
struct [[nodiscard]] LoadCurve : Outcome {
    std::vector<LoadCurvePoint> points;
    std::vector<LoadCurvePoint> limits;  ///< limit points between them, to 1e-10 of the arc length
};

/// The curve r(q, factor) = 0, phi(q) = 0 by its arc length s,
///
///     ds^2 = sum of dq_a^2 + (d factor / (to - from))^2,
///
/// angles in rad, lengths over the extent of the tree at the first point,
/// predicted along the tangent and corrected by Newton's method across it. The equations are those of steady_state(),
/// with the exact stiffness and, with loops, their multipliers.                     [Riks 1979; Crisfield 1981]
/// @throws InputError: factors that are not finite or alike, steps and numbers out of range, states (which it does not
/// know); and as steady_state() for the first point
LoadCurve load_curve(const System& system, const LoadCurveOptions& options = {});

}  // namespace cardan::solvers
