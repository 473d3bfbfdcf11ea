#pragma once

#include <vector>

namespace cardan::oracles {

/// Uniform rotating Euler-Bernoulli beam by power series (Frobenius' method), exact up to rounding: a second solution
/// beside the Ritz one. With z = (L - x)/L measured from the tip, eta = Omega sqrt(mu L^4 / EI), hub radius r = R/L and
/// b = omega sqrt(mu L^4 / EI):
///     w'''' - (T w')' - lambda w = 0,  T = eta^2 ((1 + r) z - z^2/2),  lambda = b^2 (flap) or b^2 + eta^2 (lag),
/// w'' = w''' = 0 at the tip z = 0; two series remain, whose 2x2 determinant vanishes by the conditions at the root.
/// [Wright, Smith, Thresher and Wang, J. Appl. Mech. 49 (1982) 197-202]
struct RotatingBeamSeries {
    double eta = 0.0;         ///< dimensionless rotor speed
    double hub_radius = 0.0;  ///< R / L
    bool hinged = false;      ///< root condition: clamped or hinged

    /// Dimensionless flap frequencies, rising. Digits are lost as exp(sqrt(b)): meant for the first five modes or so.
    std::vector<double> flap(int count) const;

    /// Dimensionless lag frequencies: lag^2 = flap^2 - eta^2 (mass on a line, mode by mode).
    std::vector<double> lag(int count) const;

private:
    double root_determinant(double lambda) const;
};

}  // namespace cardan::oracles
