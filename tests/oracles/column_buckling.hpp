#pragma once

namespace cardan::oracles {

/// Euler's critical loads P L^2 / EI of a uniform column, dimensionless; dead compressive force along the axis.
/// [Timoshenko and Gere, Theory of Elastic Stability, 1961, sections 2.1 and 2.2]
namespace column_buckling {

/// Clamped at the foot, free at the loaded top: pi^2 / 4.
double clamped_free();

/// Hinged at both ends: pi^2.
double hinged_hinged();

/// Clamped-free column under its own weight q per length: least q L^3 / EI = 7.8373..., the first zero of
/// J_{-1/3}(2/3 sqrt(qL^3/EI)).   [Timoshenko and Gere, section 2.12]
double clamped_free_own_weight();

}  // namespace column_buckling
}  // namespace cardan::oracles
