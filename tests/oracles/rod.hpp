#pragma once

namespace cardan::oracles {

/// Uniform rod of length L in torsion (wave speed c = sqrt(GJ / I_p), I_p polar mass inertia per length) or in
/// extension (c = sqrt(EA / mu)): omega = wave_number * c / L in rad/s.
/// [Meirovitch, Analytical Methods in Vibrations, 1967, section 5-9; Blevins 1979, tables 8-16 and 8-19]
namespace rod {

/// (i - 1/2) pi, i = 1, 2, ...: clamped at one end, free at the other.
double clamped_free_wave_number(int mode);

/// i pi: elastic modes of the free-free rod (and all of the clamped-clamped one).
double free_free_wave_number(int mode);

/// Clamped rod that carries a rigid body at its tip: beta tan(beta) = ratio, where ratio = (inertia of the rod) /
/// (inertia of the tip body) > 0, i.e. I_p L / J_tip in torsion and mu L / m_tip in extension.
double clamped_with_tip_body_wave_number(int mode, double ratio);

/// Shape of the clamped-free rod at xi = x / L, 1 at the tip (in absolute value).
double clamped_free_shape(int mode, double xi);

}  // namespace rod
}  // namespace cardan::oracles
