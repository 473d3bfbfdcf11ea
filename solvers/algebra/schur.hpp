/// @file
/// Real Schur form of a Hessenberg matrix, by double-shift QR steps with delayed updates.
#pragma once

#include "mbs/base/types.hpp"

#include <array>

namespace cardan::solvers {

/// T = Q^T H Q by Francis' implicit double-shift QR algorithm [Golub and Van Loan, Matrix Computations, 7.5]. The
/// reflectors of a step are computed in a small window that follows the bulge along the diagonal; they are applied to
/// the rest of the matrix in batches, on parts that stay in the L1 cache.
///
/// Eigen::RealSchur takes 2.8 times as long for 110 rows, 3.0 for 200 and 400, 4.3 for 800, and turns whole vectors
/// only; with it, by its share of the time, a diagram of the 5 MW machine would take a quarter longer, one with all
/// modes a third. LAPACK's dhseqr, of whole vectors, takes 1.7 to 3.5 times as long with the reference BLAS; with
/// OpenBLAS 2.4 times for 110 rows and as long for 400, half as long for 800, but that allocates.
class SchurIteration {
public:
    /// @param T  in: upper Hessenberg; out: quasi-triangular, with 2 x 2 blocks for complex pairs and zeros below
    /// @param Z  any number of rows, `size` columns; becomes Z Q
    /// @returns false if it does not converge.  Cost about 10 n^3 for a square Z; no allocation.
    [[nodiscard]] bool reduce(Matrix& T, Matrix& Z);

private:
    // I - tau v v^T, v = (1, v1, v2), on three rows or columns (two at the end of a step, v2 = 0).
    struct Reflector {
        double v1, v2, tau;
    };
    // Reflectors of a step from number `first` on, `count` of them, over `width` rows or columns.
    struct Batch {
        Eigen::Index first, count, width;
    };
    // Diagonal elements of the 2 x 2 matrix whose eigenvalues are the shifts, and the product of the others.
    struct Shift {
        double x, y, w;
    };
    using Column = std::array<double, 3>;
    static constexpr Eigen::Index most = 32;  // reflectors of a batch

    static Reflector reflector(const Column& v, double& beta);
    Eigen::Index active_from(const Matrix& T, Eigen::Index last) const;
    static Shift shift(const Matrix& T, Eigen::Index first, Eigen::Index last, int iteration);
    static Eigen::Index start_of_bulge(const Matrix& T, Eigen::Index first, Eigen::Index last, const Shift& shift,
                                       Column& v);
    void step(Matrix& T, Matrix& Z, Eigen::Index first, Eigen::Index last, const Shift& shift);
    void chase(Matrix& T, const Batch& batch, Eigen::Index last, Eigen::Index start, const Column& v);
    void turn_rows(Matrix& A, const Batch& batch, Eigen::Index from_column) const;
    void turn_columns(Matrix& A, const Batch& batch, Eigen::Index rows) const;
    static void turn(double* columns, Eigen::Index stride, Eigen::Index rows, const Reflector* h, Eigen::Index count,
                     Eigen::Index width);
    static void turn_strip(double* rows, const Reflector* h, Eigen::Index count);
    static void split(Matrix& T, Matrix& Z, Eigen::Index last);

    std::array<Reflector, most> reflectors_{};
    double negligible_ = 0;
};

}  // namespace cardan::solvers
