#pragma once

#include <Eigen/Core>

namespace cardan::oracles {

/// Planar cantilever of length 1 and bending stiffness 1, inextensible and rigid in shear, clamped at the origin along
/// x, loaded at its tip: theta' = M, M' = F_x sin theta - F_y cos theta, x' = cos theta, y' = sin theta.
/// Forces in EI/L^2, moments in EI/L, lengths in L.   [Frisch-Fay, Flexible Bars, 1962, chapters 2 and 3]
namespace elastica {

struct Tip {
    double x, y;   ///< place; the shortening is 1 - x
    double theta;  ///< slope, rad, toward +y
};

/// Tip moment, positive from x to y: an arc of radius 1/moment.
Tip under_moment(double moment);

/// Follower force, components in the axes of the tip section (x along the tangent). In these axes the curve is an
/// initial-value problem from the tip to the root; Runge-Kutta of fourth order, 1e-12.
Tip under_follower_force(const Eigen::Vector2d& force);

/// Dead force, components in the fixed axes. The slope of the tip is sought between 0 and the direction of the force,
/// by bisection; pulling or transverse forces and pushing ones with a deflection toward their transverse part.
Tip under_dead_force(const Eigen::Vector2d& force);

/// Dead transverse force > 0 by elliptic integrals.   [Bisshopp and Drucker, Quart. Appl. Math. 3, 1945, 272-275]
Tip under_transverse_force(double force);

}  // namespace elastica
}  // namespace cardan::oracles
