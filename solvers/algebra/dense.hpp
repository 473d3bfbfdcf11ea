/// @file
/// Dense kernels that allocate nothing on the heap, whatever the size, and use the vector instructions of the
/// processor.
///
/// Eigen's blocked products and factorisations allocate for more than about a hundred rows, and are compiled for any
/// x86-64.
#pragma once

#include "mbs/base/types.hpp"

#include <limits>
#include <vector>

namespace cardan::solvers {

/// Distance from 1 to the next larger number.
inline constexpr double machine_epsilon = std::numeric_limits<double>::epsilon();

/// C += sign A B.
/// @param C  must not alias A or B
void add_product(MatrixOut C, MatrixIn A, MatrixIn B, double sign = 1);

/// B := A^-1 B by elimination with row exchanges; zero pivots give infinite or undefined entries.
/// @param A  destroyed.  Cost 2/3 n^3 + 2 n^2 columns of B
void solve_in_place(Matrix& A, Matrix& B);

/// A z of a real matrix, in real arithmetic.
template <class Real, class Complexes>
ComplexVector product_in_parts(const Real& A, const Complexes& z) {
    ComplexVector out(A.rows());
    out.real() = A * z.real();
    out.imag() = A * z.imag();
    return out;
}

/// A matrix as triangular factors, for repeated solves.
class LuFactors {
public:
    explicit LuFactors(Eigen::Index n) : lu_(n, n), exchanges_(static_cast<std::size_t>(n)) {}
    /// Fill this before factorise(), which overwrites it.
    Matrix& matrix() { return lu_; }
    /// By elimination with row exchanges. Zero pivots give infinite or undefined solutions.  Cost 2/3 n^3
    void factorise();
    /// Whether no pivot is zero or not finite.
    bool regular() const;
    /// Smallest over largest magnitude of the pivots: of equations whose rows and columns are alike in size, of the
    /// order of the inverse of the condition number. 0 if a pivot is zero, not a number if one is not finite; 1 without
    /// rows.
    double pivot_ratio() const;
    /// b := A^-1 b.  Cost 2 n^2
    void solve(Vector& b) const;
    /// B := A^-1 B.  Cost 2 n^2 columns of B
    void solve(Matrix& B) const;
    /// b := A^-T b.  Cost 2 n^2
    void solve_transposed(Vector& b) const { solve_transposed_column(b.data(), b.size()); }
    /// B := A^-T B, column by column
    void solve_transposed(Matrix& B) const;

private:
    void solve_transposed_column(double* data, Eigen::Index size) const;

    Matrix lu_;
    std::vector<Eigen::Index> exchanges_;  ///< row that was exchanged with row k
};

/// Whether a symmetric matrix is positive definite, by Cholesky's factorisation.
/// @param A  the lower triangle is read; destroyed.  Cost n^3/3
bool positive_definite(Matrix& A);

}  // namespace cardan::solvers
