/// @file
/// Eigenvalues and eigenvectors of a product of matrices that is never multiplied out.
#pragma once

#include "mbs/base/types.hpp"

#include <Eigen/Jacobi>

#include <vector>

namespace cardan::solvers {

/// mu and x of F_p ... F_2 F_1 by the periodic Schur form: unitary Q_k with Q_k^H F_k Q_{k-1} upper triangular, Q_p =
/// Q_0. The eigenvalues are products of diagonal entries, so multipliers of 1e-100 beside others of 1 are computed with
/// the rounding errors of the individual factors, not of their product. Periodic QR algorithm in complex arithmetic
/// with single shifts, after two unshifted sweeps that sort by size.
///                    [Bojanczyk, Golub and Van Dooren, The periodic Schur decomposition, 1992; Kressner 2006]
class ProductEigen {
public:
    /// @param factors  F_1, F_2, ... F_p, square, all of one size
    /// @returns false if the iteration does not converge
    /// @throws InputError if there is no factor, if sizes differ or a factor is not finite
    ///
    /// Cost O(p n^3); allocates.
    [[nodiscard]] bool compute(const std::vector<Matrix>& factors);

    Eigen::Index size() const { return Q_.front().rows(); }
    Eigen::Index factors() const { return std::ssize(Q_); }

    /// log mu, imaginary part in (-pi, pi]; real part -infinity for mu = 0.
    Complex logarithm(Eigen::Index i) const;
    /// Mean over the factors of log(|entry| / norm of the factor): below about -32 it is rounding.
    double mean_level(Eigen::Index i) const;

    /// Eigenvectors of one eigenvalue, at every position k = 0 ... p - 1 between the factors (by column).
    struct Vectors {
        ComplexMatrix right;   ///< x_k: F_{k+1} x_k = growth_{k+1} x_{k+1}
        ComplexMatrix left;    ///< y_k: y_{k+1}^T F_{k+1} = growth_{k+1} y_k^T (no conjugation); y_k^T x_k = 1
        ComplexVector growth;  ///< their product is mu
        /// Largest |x_k| |y_k|: factor by which a relative perturbation of the factors is amplified in log mu, >= 1.
        double condition = 0;
    };
    /// For eigenvalues that mean_level() shows to be above rounding. Cost O(p n^2).
    Vectors vectors(Eigen::Index i) const;

private:
    using Rotation = Eigen::JacobiRotation<Complex>;

    std::vector<Matrix> start(const std::vector<Matrix>& factors);
    void reduce(std::vector<Matrix> F);
    void rotate(Eigen::Index space, Eigen::Index i, const Rotation& G);
    void chase(Eigen::Index i);
    bool iterate();
    Eigen::Index active_from(Eigen::Index last, double negligible);
    Complex shift(Eigen::Index first, Eigen::Index last) const;
    void sweep(Eigen::Index first, Eigen::Index last, Complex sigma);
    ComplexMatrix right_coefficients(Eigen::Index j) const;
    ComplexMatrix left_coefficients(Eigen::Index j) const;
    ComplexVector diagonal(Eigen::Index j) const;
    ComplexMatrix& H() { return T_.back(); }
    const ComplexMatrix& H() const { return T_.back(); }

    std::vector<ComplexMatrix>
        T_;  // factors over their norms, triangular in the end; the last one by way of Hessenberg
    std::vector<ComplexMatrix> Q_;  // bases of the places between them
    std::vector<double> norms_;
};

}  // namespace cardan::solvers
