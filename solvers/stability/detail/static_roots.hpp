/// @file
/// Stability against motions so slow that all states follow. Internal: not for users of the library.
#pragma once

#include "solvers/linear/linearise.hpp"

#include <vector>

namespace cardan::solvers {

/// Real eigenvalues of
///
///     K_static x = mu (K_e + sigma^2 M) x,
///
/// K_static with the states where they come to rest (static_stiffness()). One of them is zero exactly where the
/// complete state matrix has the eigenvalue zero, since its determinant is that of K_static but for factors that do not
/// vanish. Stiff springs have mu = 1, so that roots near zero are as good as the springs, whatever the stiffest of
/// them. Under loads without a potential, as of the air, two roots may meet and become complex, and real again with
/// the other sign: how many are negative does not tell how many motions grow.
struct StaticRoots {
    double sigma = 0;                 ///< near the lowest frequency, rad/s
    std::vector<double> values = {};  ///< ascending
    Matrix shapes = {};               ///< their vectors, by column, over the rows of the system
    /// Product of all roots, complex ones included; that of K_static changes its sign where one of them is zero.
    double product = 1;
};

/// A free spin, on which nothing depends, is left out.
/// @throws NumericalError as static_stiffness(), and for an elastic stiffness that is not one of springs
StaticRoots static_roots(const SecondOrderSystem& system);

/// Left vector y of a root, y^T (K_static - mu (K_e + sigma^2 M)) = 0: how much a load on each row has to do with it.
/// @param mu  one of static_roots()
Vector left_shape(const SecondOrderSystem& system, double sigma, double mu);

/// On which side of zero of a static root that passes through it does a motion grow: where the root is negative (true;
/// as of a spring that becomes negative) or positive (false; damping along it is negative)? With x the vector of the
/// root, y its left one and W = K_e + sigma^2 M the complete system has there, to first order in both, the real
/// eigenvalue
///
///     lambda = -mu (y^T W x) / (y^T C_0 x),  C_0 = C + Q_s f_s^-1 (f_qd + f_s^-1 f_q),
///
/// the states following slowly. Where C_0 does nothing along it, as without damping and with gyroscopic forces,
///
///     lambda^2 = -mu (y^T W x) / (y^T (M_0 x - C_0 z)),  K_static z = C_0 x,  M_0 = M + Q_s f_s^-2 (f_qd + f_s^-1
///     f_q).
///
/// An unstable top that is held upright by its spin falls when one of its two negative springs becomes positive.
/// @param k  of the roots, near zero
bool grows_below_zero(const SecondOrderSystem& system, const StaticRoots& roots, int k);

}  // namespace cardan::solvers
