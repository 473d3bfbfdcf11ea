#pragma once

namespace cardan::oracles {

/// Lateral buckling (bending sideways with torsion) of a deep narrow cantilever, clamped against torsion, warping free,
/// EI_y >> EI_z, so that the deflection in the plane of the load is neglected. Forces in sqrt(EI_z GJ) / L^2, moments
/// in sqrt(EI_z GJ) / L.
namespace lateral_buckling {

/// Dead transverse force at the centroid of the tip: phi'' + P^2 (1 - x)^2 phi = 0, phi(0) = phi'(1) = 0, i.e. the
/// first zero of J_{-1/4}(P/2): 4.0126.   [Prandtl 1899; Michell 1899; Timoshenko and Gere 1961, section 6.3]
double tip_force();

/// As tip_force() for a finite EI_y / EI_z and GJ / EI_z (here EI_z = L = 1, force in EI_z / L^2): lateral perturbation
/// of the planar elastica. In the axes of the sections, with k_1 = m_1 / GJ, k_2 = m_2 / EI_y, k_3 = m_3 / EI_z,
///   n' = -k x n,  m' = -k x m - e_x x n                                                                 [Kirchhoff]
/// linearised in (n_y, m_x, m_z), which start from (1, 0, 0) at the tip; the clamped root demands n_y = 0 (what is left
/// is a rotation of the whole about the force). Runge-Kutta of fourth order, 1e-10.
double tip_force_with_deflection(double EI_y, double GJ);

/// Moment by a pair of dead forces along x at the ends of a stiff arm that lies along z (quasi-tangential): the moment
/// turns with the tip's torsion but not with its lateral slope; phi'' + M^2 (phi - phi(1)) = 0: pi / 2.
/// [Ziegler, Principles of Structural Stability, 1968, section 5.5]
double quasi_tangential_moment();

/// Half of the moment about a fixed axis, half about an axis of the tip section (semi-tangential): pi.
/// The moments about a fixed axis and about one of the section have no potential and no neighbouring equilibrium at
/// all.
double semi_tangential_moment();

}  // namespace lateral_buckling
}  // namespace cardan::oracles
