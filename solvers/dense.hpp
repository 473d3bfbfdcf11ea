/// @file
/// Dense kernels that take no memory from the heap, whatever the size.
///
/// Eigen's blocked products and factorisations do, for matrices of more than about a hundred rows; these go through the
/// same products in pieces small enough for the stack.
#pragma once

#include "mbs/types.hpp"

namespace cardan::solvers {

/// C += sign A B.
/// @param C  no alias of A or B
void add_product(MatrixOut C, MatrixIn A, MatrixIn B, double sign = 1);

/// B := A^-1 B by elimination with row exchanges; zero pivots give infinite or undefined entries.
/// @param A  destroyed.  Cost 2/3 n^3 + 2 n^2 columns of B
void solve_in_place(Matrix& A, Matrix& B);

/// Whether a symmetric matrix is positive definite, by Cholesky's factorisation.
/// @param A  the lower triangle is read; destroyed.  Cost n^3/3
bool positive_definite(Matrix& A);

}  // namespace cardan::solvers
