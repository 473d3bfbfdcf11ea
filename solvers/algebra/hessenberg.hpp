/// @file
/// Hessenberg form of a real matrix.
#pragma once

#include "mbs/base/types.hpp"

namespace cardan::solvers {

/// T = Q^T A Q with zeros below the first subdiagonal, by Householder reflections [Golub and Van Loan, Matrix
/// Computations, 7.4]. Each of them goes over the matrix twice: once to be applied from the left and to collect what
/// the application from the right needs, once for that. Eigen goes over it four times, with SSE2.
class Hessenberg {
public:
    explicit Hessenberg(Eigen::Index size) : v_(size), w_(size) {}

    /// @param T  in: A; out: T
    /// @param Z  any number of rows, `size` columns; becomes Z Q.  Cost 10/3 n^3 and 2 n^2 per row of Z; no allocation
    ///           unless Z has more rows than columns.
    void reduce(Matrix& T, Matrix& Z);

private:
    Vector v_, w_;
};

}  // namespace cardan::solvers
