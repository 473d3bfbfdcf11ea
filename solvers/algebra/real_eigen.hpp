/// @file
/// Eigenvalues and eigenvectors of a sequence of real matrices, in the same memory.
#pragma once

#include "mbs/base/types.hpp"
#include "solvers/algebra/schur.hpp"

#include <memory>
#include <vector>

namespace cardan::solvers {

/// A x = mu x for general real matrices (entries from 1e-140 to 1e140) of one size: Hessenberg form (Eigen's), real
/// Schur form, back substitution. Backward stable, without balancing: ||A||-relative errors of the order of rounding.
/// Only the first rows of every eigenvector are computed (for a state matrix the positions), which saves half of the
/// transformations.
///
/// Why this and not Eigen or LAPACK: see docs/dependencies.md.
class RealEigen {
public:
    /// @param rows  number of eigenvector rows wanted, 0 ... size
    RealEigen(Eigen::Index size, Eigen::Index rows);
    RealEigen(const RealEigen&) = delete;
    RealEigen& operator=(const RealEigen&) = delete;
    ~RealEigen();

    /// One real eigenvalue, or the member of a complex pair with positive imaginary part.
    struct Value {
        Complex mu;
        Eigen::Index column;  ///< of vectors(): x, or Re x with Im x in the next column (complex eigenvalues)
    };

    /// @returns false if the iteration does not converge.  Cost about 10 size^3; no allocation.
    [[nodiscard]] bool compute(const Matrix& A);

    /// In the order of the Schur form.
    const std::vector<Value>& values() const { return values_; }
    /// rows x size, not normalised.
    const Matrix& vectors() const { return vectors_; }

private:
    void back_substitute(Complex mu, Eigen::Index top);
    bool is_rounding(Complex value) const;
    void eliminate(Complex mu, Eigen::Index i);
    void eliminate_pair(Complex mu, Eigen::Index i);
    void subtract_column(Eigen::Index i, Eigen::Index above);
    Complex y(Eigen::Index i) const { return {y_(i, 0), y_(i, 1)}; }
    void set_y(Eigen::Index i, Complex value) { y_(i, 0) = value.real(), y_(i, 1) = value.imag(); }

    struct Hessenberg;  // Eigen's, whose header takes long to compile
    std::unique_ptr<Hessenberg> hessenberg_;
    SchurIteration schur_;
    Matrix T_, Z_, vectors_;
    Eigen::Matrix<double, Eigen::Dynamic, 2> y_;  // eigenvector of T: real and imaginary part
    double small_ = 0;                            // smaller pivots than this are rounding
    double size_ = 1;                             // of the eigenvector of T so far
    std::vector<Value> values_;
};

}  // namespace cardan::solvers
