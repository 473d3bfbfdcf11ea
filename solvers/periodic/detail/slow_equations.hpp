/// @file
/// Equations of slow motions at one azimuth, see SlowMotions.
#pragma once

#include "solvers/periodic/periodic_system.hpp"

namespace cardan::solvers {

/// A B
Matrix product(const Matrix& A, const Matrix& B);
/// A B^-1
Matrix divided(const Matrix& A, const Matrix& B);

/// Equations at one azimuth and their motions as if they stayed like this.
struct SlowAzimuth {
    SlowAzimuth(const PeriodicSystem& system, double time);
    SecondOrderSystem at;
    Matrix vectors;  ///< unit modal masses
    Vector squares;  ///< of the frequencies, ascending; negative: unstable
};

/// q, q' of z, z' at one azimuth, the derivatives of V and W, and the equations of z.
struct SlowWay {
    Matrix X, Y, V, W, dV, dW, a, b;
};

/// Residual of the equations: forces along the fast vectors, and a and b by those along the slow ones.
struct SlowRemainder {
    SlowRemainder(const SlowAzimuth& azimuth, const SlowWay& way);
    Matrix X, Y, a, b;  ///< corrections of X and Y; a and b anew
};

}  // namespace cardan::solvers
