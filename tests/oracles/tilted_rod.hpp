// The rod that a chain of cardanic elements with plain springs tends to.
#pragma once

#include "tests/oracles/cosserat_rod.hpp"

namespace cardan::oracles {

/// What becomes of a chain of cardanic elements of vanishing length. A shear strain tilts the middle body against the
/// terminal ones, which carry the section axes, by a = gamma / (1 - 2 delta); the torsion turns about the tilted axis d
/// and the bending about z about an axis that has followed the tilt about y:
///     1 + Gamma = 2 delta e1 + (1 - 2 delta + eps) d,   d = Ry(ay) Rz(az) e1,
///     kappa = kappa_x d + kappa_y e2 + kappa_z Ry(ay) e3,   ay = -gamma_z / (1 - 2 delta), az = gamma_y / (1 - 2
///     delta).
/// The law is C^-1 g = (dGamma/dg)^T n + (dkappa/dg)^T m over g = (eps, gamma_y, gamma_z, kappa_x, kappa_y, kappa_z).
CosseratRod limit_of_elements(CosseratRod rod, double delta);

}  // namespace cardan::oracles
