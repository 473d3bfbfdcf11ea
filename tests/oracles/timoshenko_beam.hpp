#pragma once

#include <vector>

namespace cardan::oracles {

/// Uniform Timoshenko beam of length L: natural frequencies from the exact transcendental equation.
///
/// With b^2 = omega^2 mu L^4 / EI, r = sqrt(I/A) / L and s^2 = EI / (k G A L^2) = (E / kG) r^2 the deflection obeys
///     W'''' + b^2 (r^2 + s^2) W'' - b^2 (1 - b^2 r^2 s^2) W = 0,    psi' = W'' + b^2 s^2 W
/// (' = d/dxi, psi the rotation of the section, W the deflection over L). Four boundary conditions give a 4x4 matrix
/// whose determinant vanishes at the natural frequencies; its columns use cosh(kappa xi) and kappa sinh(kappa xi)
/// with kappa^2 real of either sign, so the cut-off frequency b = 1/(r s) needs no case of its own.
/// [Huang, J. Appl. Mech. 28 (1961) 579-584]
class TimoshenkoBeam {
public:
    enum class Ends { clamped_free, free_free, hinged_hinged };

    /// @param radius_of_gyration  r = sqrt(I/A) / L, dimensionless, > 0
    /// @param modulus_ratio       E / (k G), dimensionless, > 0
    TimoshenkoBeam(double radius_of_gyration, double modulus_ratio);

    /// First `count` elastic frequencies omega / sqrt(EI / (mu L^4)), rising. The determinant loses digits as
    /// exp(beta), beta^4 = b^2: meant for the first ten modes or so.
    std::vector<double> frequencies(Ends ends, int count) const;

    /// Both frequencies (bending and shear branch) of half-wave number n of the hinged-hinged beam, closed form.
    /// W = sin(n pi xi), psi = P cos(n pi xi): a quadratic equation for b^2.
    struct Branches {
        double bending;
        double shear;
    };
    Branches hinged_hinged(int half_waves) const;

    /// Determinant of the (column-scaled) boundary matrix at the dimensionless frequency b.
    double boundary_determinant(Ends ends, double b) const;

private:
    double r2_;
    double s2_;
};

}  // namespace cardan::oracles
