/// @file
/// The products and substitutions that the dense kernels are made of, in whole registers.
///
/// Eigen's, compiled for any x86-64, take 1.3 to 1.7 times as long from 60 to 400 rows with clang 14 (AVX2 without
/// FMA), factorisations 1.4 to 1.6 times, up to four times as long with GCC (FMA); a quarter of the time of a diagram
/// of two blades is spent here. They also allocate for more than about a hundred rows.
#pragma once

#include <cstddef>

namespace cardan::solvers {

/// Depth of a product by one call: what is packed stays in the first cache.
inline constexpr std::ptrdiff_t product_depth = 48;

/// C += sign A B with A m x depth and B depth x n, columns one after the other at distances lda, ldb, ldc.
/// @param depth  product_depth at most
///
/// C must not overlap with A or B.  Nothing is allocated.  Plain twin: Eigen's product (tests/solvers/algebra)
void add_block_product(std::ptrdiff_t m, std::ptrdiff_t n, std::ptrdiff_t depth, double sign, const double* A,
                       std::ptrdiff_t lda, const double* B, std::ptrdiff_t ldb, double* C, std::ptrdiff_t ldc);

/// Columns of B := L^-1 B, L the lower triangle of a k x k matrix A with ones on its diagonal.
void solve_unit_lower(std::ptrdiff_t k, const double* A, std::ptrdiff_t lda, std::ptrdiff_t columns, double* B,
                      std::ptrdiff_t ldb);
/// Columns of B := U^-1 B, U the upper triangle of A.
void solve_upper(std::ptrdiff_t k, const double* A, std::ptrdiff_t lda, std::ptrdiff_t columns, double* B,
                 std::ptrdiff_t ldb);

}  // namespace cardan::solvers
