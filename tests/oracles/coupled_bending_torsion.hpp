#pragma once

#include <vector>

namespace cardan::oracles {

/// Uniform cantilever whose mass centre lies at the distance e beside its straight elastic axis: bending w and torsion
/// phi of the elastic axis are coupled by inertia, harmonic motion with omega:
///     EI w'''' + rho_I omega^2 w'' - mu omega^2 (w + e phi) = 0
///     GJ phi'' + omega^2 ((J_c + mu e^2) phi + mu e w) = 0
/// clamped at x = 0, free at x = L (w'' = 0, EI w''' + rho_I omega^2 w' = 0, phi' = 0). Exact: the three roots k^2 of
/// the characteristic cubic give six solutions, a 6x6 determinant vanishes at the natural frequencies.
/// [Dokumaci, J. Sound Vib. 119 (1987) 443-449; Banerjee, J. Sound Vib. 224 (1999) 267-281; with rho_I added]
struct CoupledBendingTorsion {
    double length;              ///< m
    double bending_stiffness;   ///< EI, N m^2
    double torsion_stiffness;   ///< GJ, N m^2
    double mass_per_length;     ///< mu, kg/m
    double mass_centre_offset;  ///< e, m, not zero
    double polar_inertia;       ///< J_c per length about the mass centre, kg m
    double rotary_inertia;      ///< rho_I per length of the bending rotation, kg m, may be zero

    /// First `count` natural frequencies, rad/s, rising; none is missed that lies further than `step` (rad/s) from the
    /// next one.
    std::vector<double> frequencies(int count, double step) const;

private:
    double boundary_determinant(double omega) const;
};

}  // namespace cardan::oracles
