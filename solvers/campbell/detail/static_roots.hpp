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
/// them.
struct StaticRoots {
    double sigma = 0;                 ///< near the lowest frequency, rad/s
    std::vector<double> values = {};  ///< ascending
    Matrix shapes = {};               ///< their vectors, by column, over the rows of the system
    /// Of all roots, complex ones included: of those of K_static, it changes its sign where one of them is zero.
    double product = 1;
};

/// A free spin, on which nothing depends, is left out.
/// @throws NumericalError as static_stiffness(), and for an elastic stiffness that is not one of springs
StaticRoots static_roots(const SecondOrderSystem& system);

/// Left vector y of a root, y^T (K_static - mu (K_e + sigma^2 M)) = 0: how much a load on each row has to do with it.
/// @param mu  one of static_roots()
Vector left_shape(const SecondOrderSystem& system, double sigma, double mu);

}  // namespace cardan::solvers
