/// @file
/// The largest eigenvalues of an operator, all of them and with certainty as far as random vectors can give it.
#pragma once

#include "mbs/base/types.hpp"

#include <functional>
#include <vector>

namespace cardan::solvers {

/// y = A x for a real, general A.
using LinearOperator = std::function<void(const Vector& x, Vector& y)>;

struct DominantOptions {
    double min_magnitude = 0;  ///< magnitude from which on eigenvalues are wanted; > 0
    double tolerance = 1e-15;  ///< residual of an eigenpair beside the eigenvalue, as the Krylov space tells it
    int max_vectors = 200;     ///< limit of vectors in one Krylov space
};

/// Eigenvalues of magnitude `min_magnitude` and more, and a few that are smaller.
struct DominantEigen {
    struct Value {
        Complex mu;            ///< of complex pairs the one with positive imaginary part
        ComplexVector vector;  ///< of unit norm
    };
    bool complete = false;           ///< otherwise the limit of vectors was reached, and there are no values
    std::vector<Value> values = {};  ///< by magnitude, the largest first
    int products = 0;                ///< with the operator
};

/// By Arnoldi's method with full orthogonalisation [Saad, Numerical Methods for Large Eigenvalue Problems, ch. 6]: the
/// Krylov space of a random vector grows until all Ritz values of magnitude `min_magnitude` and more, and the next
/// smaller one, have converged. What was found is deflated, and the search starts again with another random vector
/// until it finds nothing more: one vector yields one eigenvector of a multiple eigenvalue only. The eigenpairs are
/// those of the operator projected on all that was found. The random vectors are the same in every call.
///
/// Spectra's implicitly restarted method takes a number of eigenvalues, not a magnitude, and does not deflate. For
/// 352 rows and 32 eigenvalues it takes as long, with as many products. In numbers doubled until they suffice it takes
/// 0.4 times as long for 240 rows and some 22 eigenvalues, most of them triple, as of three blades that are alike; but
/// of 150 such operators it lost an eigenvalue of one, which would be a mode that is missing in a diagram.
///
/// Cost for k values in a space of m vectors: some 1.5 m products, 3 n m^2 for the orthogonalisation, some 20 m^3.
/// @throws InputError for options out of range
DominantEigen dominant_eigenvalues(const LinearOperator& A, Eigen::Index size, const DominantOptions& options);

}  // namespace cardan::solvers
