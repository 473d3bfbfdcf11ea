/// @file
/// Hill's method for E(psi) dx/dt + A(psi) x = 0 with trigonometric polynomials of second degree: another way to
/// Floquet exponents than integration, and one that takes descriptor systems as they are.
#pragma once

#include "examples/studies/beams/mixed_beam.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"

#include <Eigen/SparseLU>

#include <algorithm>
#include <array>
#include <functional>

namespace cardan::testing {

/// x = exp(exponent psi) sum_h x_h exp(i h psi), h = -harmonics ... harmonics.      [Hill, Acta Math. 8 (1886) 1-36]
class Hill {
public:
    Hill(const std::function<DescriptorPencil(double azimuth)>& at, double rotor_speed, int harmonics)
        : speed_(rotor_speed), harmonics_(harmonics) {
        constexpr int samples = 5;  // as many as coefficients, so a polynomial of second degree is met exactly
        std::array<DescriptorPencil, samples> sampled;
        for (int i = 0; i < samples; ++i) entry(sampled, i) = at(2 * pi * i / samples);
        size_ = sampled[0].E.rows();
        for (int k = -2; k <= 2; ++k) {
            ComplexMatrix E = ComplexMatrix::Zero(size_, size_), A = E;
            for (int i = 0; i < samples; ++i) {
                const Complex factor = std::exp(Complex(0, -2 * pi * i * k / samples)) / double(samples);
                E += factor * entry(sampled, i).E;
                A += factor * entry(sampled, i).A;
            }
            coefficients_.push_back({k, E, A});
        }
    }

    struct Mode {
        Complex exponent;     ///< per rev
        ComplexMatrix shape;  ///< unknowns by harmonics -H ... H
        double residual;      ///< of the inverted eigenvalue problem, relative
    };

    /// Modes whose exponents lie around a guess, nearest first: Arnoldi's method on (P + guess Q)^-1 Q, where
    /// (P + exponent Q) x = 0. Those with a residual below 1e-8.
    std::vector<Mode> near(Complex guess, int dimension = 40) const {
        using Sparse = Eigen::SparseMatrix<Complex>;
        const Eigen::Index n = size_ * (2 * harmonics_ + 1);
        std::vector<Eigen::Triplet<Complex>> p, q;
        for (int m = -harmonics_; m <= harmonics_; ++m)
            for (const Coefficient& c : coefficients_) {
                const int h = m - c.k;
                if (std::abs(h) > harmonics_) continue;
                add(p, m, h, c.A + speed_ * (guess + Complex(0, h)) * c.E);
                add(q, m, h, speed_ * c.E);
            }
        Sparse P(n, n), Q(n, n);
        P.setFromTriplets(p.begin(), p.end());
        Q.setFromTriplets(q.begin(), q.end());
        const Eigen::SparseLU<Sparse> lu(P);
        // Starts, and is put back, in the range of the inverse: no infinite eigenvalues.
        ComplexMatrix V = ComplexMatrix::Zero(n, dimension + 1), H = ComplexMatrix::Zero(dimension + 1, dimension);
        for (Eigen::Index i = 0; i < n; ++i) V(i, 0) = 1 + 0.7 * std::sin(1.0 + 3.7 * static_cast<double>(i));
        for (int i = 0; i < 4; ++i) V.col(0) = ComplexVector(lu.solve(Q * V.col(0))).normalized();
        for (int j = 0; j < dimension; ++j) {
            ComplexVector w = lu.solve(Q * V.col(j));
            for (int pass = 0; pass < 2; ++pass) {
                const ComplexVector along = V.leftCols(j + 1).adjoint() * w;
                w -= V.leftCols(j + 1) * along;
                H.col(j).head(j + 1) += along;
            }
            H(j + 1, j) = w.norm();
            V.col(j + 1) = w.normalized();
        }
        const Eigen::ComplexEigenSolver<ComplexMatrix> ritz(ComplexMatrix(H.topRows(dimension)));
        std::vector<Mode> modes;
        for (Eigen::Index i = 0; i < dimension; ++i) {
            const Complex nu = ritz.eigenvalues()(i);
            const ComplexVector y = ritz.eigenvectors().col(i), x = V.leftCols(dimension) * y;
            const double residual = std::abs(H(dimension, dimension - 1) * y(dimension - 1)) / std::abs(nu);
            if (residual > 1e-8) continue;
            modes.push_back(
                {guess - 1.0 / nu, Eigen::Map<const ComplexMatrix>(x.data(), size_, 2 * harmonics_ + 1), residual});
        }
        std::sort(modes.begin(), modes.end(), [&](const Mode& a, const Mode& b) {
            return std::abs(a.exponent - guess) < std::abs(b.exponent - guess);
        });
        return modes;
    }

private:
    struct Coefficient {
        int k;
        ComplexMatrix E, A;
    };
    void add(std::vector<Eigen::Triplet<Complex>>& list, int row, int column, const ComplexMatrix& block) const {
        const Eigen::Index r = size_ * (row + harmonics_), c = size_ * (column + harmonics_);
        for (Eigen::Index j = 0; j < size_; ++j)
            for (Eigen::Index i = 0; i < size_; ++i)
                if (std::abs(block(i, j)) > 1e-14)
                    list.emplace_back(static_cast<int>(r + i), static_cast<int>(c + j), block(i, j));
    }

    double speed_;
    int harmonics_;
    Eigen::Index size_ = 0;
    std::vector<Coefficient> coefficients_;
};

}  // namespace cardan::testing
