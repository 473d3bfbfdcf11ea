/// @file
/// Eigen's products and triangular solves of matrices of any size, which every source that multiplies two matrices
/// would compile anew, some of them with less optimisation: compiled once, here. For our own precompiled headers only;
/// users, who may have wider registers, compile Eigen's. Sources do not rely on it.
#pragma once

#include <Eigen/Core>

// The names are internal to Eigen 3.4.
#if EIGEN_VERSION_AT_LEAST(3, 4, 0) && !EIGEN_VERSION_AT_LEAST(3, 4, 90) && !defined(EIGEN_USE_BLAS)
#define CARDAN_PRODUCTS(DECLARE)                                                                                       \
    DECLARE struct gebp_kernel<double, double, Index, blas_data_mapper<double, Index, ColMajor, Unaligned, 1>,         \
                               gebp_traits<double, double>::mr, gebp_traits<double, double>::nr, false, false>;        \
    DECLARE struct gemm_pack_lhs<double, Index, const_blas_data_mapper<double, Index, ColMajor>,                       \
                                 gebp_traits<double, double>::mr, gebp_traits<double, double>::LhsProgress,            \
                                 gebp_traits<double, double>::LhsPacket4Packing, ColMajor, false, false>;              \
    DECLARE struct gemm_pack_lhs<double, Index, const_blas_data_mapper<double, Index, RowMajor>,                       \
                                 gebp_traits<double, double>::mr, gebp_traits<double, double>::LhsProgress,            \
                                 gebp_traits<double, double>::LhsPacket4Packing, RowMajor, false, false>;              \
    DECLARE struct gemm_pack_rhs<double, Index, const_blas_data_mapper<double, Index, ColMajor>,                       \
                                 gebp_traits<double, double>::nr, ColMajor, false, false>;                             \
    DECLARE struct gemm_pack_rhs<double, Index, const_blas_data_mapper<double, Index, RowMajor>,                       \
                                 gebp_traits<double, double>::nr, RowMajor, false, false>;                             \
    DECLARE struct gemm_pack_rhs<double, Index, blas_data_mapper<double, Index, ColMajor, Unaligned, 1>,               \
                                 gebp_traits<double, double>::nr, ColMajor, false, true>;                              \
    DECLARE struct general_matrix_vector_product<Index, double, const_blas_data_mapper<double, Index, ColMajor>,       \
                                                 ColMajor, false, double,                                              \
                                                 const_blas_data_mapper<double, Index, RowMajor>, false, Specialized>; \
    DECLARE struct general_matrix_vector_product<Index, double, const_blas_data_mapper<double, Index, ColMajor>,       \
                                                 ColMajor, false, double,                                              \
                                                 const_blas_data_mapper<double, Index, ColMajor>, false, Specialized>; \
    DECLARE struct general_matrix_vector_product<Index, double, const_blas_data_mapper<double, Index, RowMajor>,       \
                                                 RowMajor, false, double,                                              \
                                                 const_blas_data_mapper<double, Index, ColMajor>, false, Specialized>; \
    DECLARE struct triangular_solve_matrix<double, Index, OnTheLeft, Lower, false, ColMajor, ColMajor, 1>;             \
    DECLARE struct triangular_solve_matrix<double, Index, OnTheLeft, UnitLower, false, ColMajor, ColMajor, 1>;         \
    DECLARE struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, ColMajor, ColMajor, 1>;             \
    DECLARE struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, RowMajor, ColMajor, 1>;

namespace Eigen::internal {
CARDAN_PRODUCTS(extern template)
}
#endif
