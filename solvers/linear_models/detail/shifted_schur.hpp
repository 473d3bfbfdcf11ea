/// @file
/// Invariant subspaces and Lyapunov equations of state matrices whose eigenvalues differ by many decades.
#pragma once

#include "mbs/base/types.hpp"

#include <functional>
#include <vector>

namespace cardan::solvers {

/// Complex Schur form (A - sigma)^-1 = U T U^H with sigma > 0 near the lowest eigenvalues: these, which matter for a
/// machine, are computed to working precision however stiff the others are.
class ShiftedSchur {
public:
    /// @param sigma  0: of the magnitude of the lowest tenth of the eigenvalues, zeros excluded
    /// @throws NumericalError if the iteration fails or an entry is not finite
    explicit ShiftedSchur(const Matrix& A, double sigma = 0);

    double sigma() const { return sigma_; }
    Eigen::Index size() const { return T_.rows(); }
    /// Eigenvalues of A in the order of the form.
    Complex eigenvalue(Eigen::Index i) const { return sigma_ + 1.0 / T_(i, i); }
    /// X of A X + X A^T + Q = 0.  @throws NumericalError if eigenvalues add up to nearly zero
    Matrix lyapunov(const Matrix& Q) const;
    /// Orthonormal real basis of the invariant subspace of some eigenvalues (of a pair both or neither).
    /// @param chosen  one flag per eigenvalue
    Matrix subspace(std::vector<bool> chosen) const;

private:
    double sigma_;
    Matrix inverse_;
    ComplexMatrix T_, U_;
};

/// A model matrix in two blocks: x = [right_1 right_2] z, z = [left_1; left_2] x.
struct Decoupled {
    Matrix right_1, right_2, left_1, left_2;
    Matrix A_1, A_2;
};
/// @param first  which eigenvalues belong to the first block; the one with positive imaginary part decides for its
///               conjugate
Decoupled decouple(const Matrix& A, const ShiftedSchur& schur, const std::function<bool(Complex)>& first);

}  // namespace cardan::solvers
