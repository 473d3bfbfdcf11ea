#pragma once

namespace cardan::oracles {

/// Jacobi's elliptic functions of argument u and modulus k (not the parameter m = k^2), all dimensionless.
struct JacobiElliptic {
    double am;  ///< amplitude, rad, continuous in u (not folded)
    double sn;
    double cn;
    double dn;
};

/// sn, cn, dn, am by the descending Landen transformation on the arithmetic-geometric mean, 0 <= k <= 1.
/// [Abramowitz and Stegun 1964, 16.4]
JacobiElliptic jacobi_elliptic(double u, double k);

/// Complete elliptic integral of the first kind K(k) = pi / (2 agm(1, sqrt(1 - k^2))), 0 <= k < 1.
/// [Abramowitz and Stegun 1964, 17.6]
double complete_elliptic_k(double k);

}  // namespace cardan::oracles
