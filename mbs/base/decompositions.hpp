/// @file
/// Eigen's dense decompositions, of dynamic size, compiled once because they dominate compile time. Include this
/// instead of Eigen's own headers.
#pragma once

#include "mbs/base/types.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

// Explicitly instantiated in sources of the same names; each takes as long to compile as a batch of others.
#define CARDAN_FACTORISATIONS(DECLARE)                                                                                \
    DECLARE class PartialPivLU<cardan::Matrix>;                                                                       \
    DECLARE PartialPivLU<cardan::Matrix>::PartialPivLU(const EigenBase<cardan::Matrix>&);                             \
    DECLARE class LLT<cardan::Matrix>;                                                                                \
    DECLARE LLT<cardan::Matrix>& LLT<cardan::Matrix>::compute(const EigenBase<cardan::Matrix>&);                      \
    DECLARE class HouseholderQR<cardan::Matrix>;                                                                      \
    DECLARE class ColPivHouseholderQR<cardan::Matrix>;                                                                \
    DECLARE class CompleteOrthogonalDecomposition<cardan::Matrix>;                                                    \
    DECLARE void CompleteOrthogonalDecomposition<cardan::Matrix>::_solve_impl(const cardan::Vector&, cardan::Vector&) \
        const;                                                                                                        \
    DECLARE class JacobiSVD<cardan::Matrix>;
#define CARDAN_EIGENVALUES(DECLARE)                                                                  \
    DECLARE class HessenbergDecomposition<cardan::Matrix>;                                           \
    DECLARE class Tridiagonalization<cardan::Matrix>;                                                \
    DECLARE class SelfAdjointEigenSolver<cardan::Matrix>;                                            \
    DECLARE SelfAdjointEigenSolver<cardan::Matrix>& SelfAdjointEigenSolver<cardan::Matrix>::compute( \
        const EigenBase<cardan::Matrix>&, int);                                                      \
    DECLARE class GeneralizedSelfAdjointEigenSolver<cardan::Matrix>;
#define CARDAN_GENERAL_EIGENVALUES(DECLARE)                                                                        \
    DECLARE class RealSchur<cardan::Matrix>;                                                                       \
    DECLARE RealSchur<cardan::Matrix>& RealSchur<cardan::Matrix>::compute(const EigenBase<cardan::Matrix>&, bool); \
    DECLARE class EigenSolver<cardan::Matrix>;                                                                     \
    DECLARE EigenSolver<cardan::Matrix>& EigenSolver<cardan::Matrix>::compute(const EigenBase<cardan::Matrix>&, bool);
#define CARDAN_COMPLEX_DECOMPOSITIONS(DECLARE)         \
    DECLARE class PartialPivLU<cardan::ComplexMatrix>; \
    DECLARE PartialPivLU<cardan::ComplexMatrix>::PartialPivLU(const EigenBase<cardan::ComplexMatrix>&);

namespace Eigen {
CARDAN_FACTORISATIONS(extern template)
CARDAN_EIGENVALUES(extern template)
CARDAN_GENERAL_EIGENVALUES(extern template)
CARDAN_COMPLEX_DECOMPOSITIONS(extern template)
}  // namespace Eigen

namespace cardan {

/// Q of A = Q R, with Q [rows x rows] orthogonal. Eigen's product of reflections, compiled once.
Matrix orthogonal_factor(const Matrix& A);
/// Q of A P = Q R.
Matrix orthogonal_factor(const Eigen::ColPivHouseholderQR<Matrix>& qr);
/// Estimate of 1 / (|A| |A^-1|) in the norm of column sums; 0 if A is singular. Compiled once, too.
double reciprocal_condition(const Eigen::PartialPivLU<Matrix>& lu);

}  // namespace cardan
