// The curvature tensor from its definition: Christoffel symbols of the second kind from the plain sums of
// mbs/kernels/lagrange, their derivatives by the complex step. Nothing of it is shared with mbs/geometry/curvature.
#pragma once

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/kernels/lagrange.hpp"

namespace cardan::testing {

class RiemannOracle {
public:
    /// @param coordinates  those of the submanifold; the others are held fixed
    RiemannOracle(const Model& model, const Vector& q, const std::vector<int>& coordinates)
        : model_(model), at_(coordinates), n_(static_cast<int>(coordinates.size())) {
        constexpr double h = 1e-40;
        const std::vector<Complex> here = second_kind(q.cast<Complex>());
        std::vector<std::vector<Complex>> shifted;
        for (int c : at_) {
            ComplexVector z = q.cast<Complex>();
            z(c) += Complex(0, h);
            shifted.push_back(second_kind(z));
        }
        const auto gamma = [&](int a, int b, int c) { return here[index(a, b, c)].real(); };
        const auto d = [&](int e, int a, int b, int c) { return entry(shifted, e)[index(a, b, c)].imag() / h; };
        // R^a_bcd = d_c Gamma^a_bd - d_d Gamma^a_bc + Gamma^a_ce Gamma^e_bd - Gamma^a_de Gamma^e_bc
        std::vector<double> mixed(static_cast<std::size_t>(n_ * n_ * n_ * n_));
        for (int a = 0; a < n_; ++a)
            for (int b = 0; b < n_; ++b)
                for (int c = 0; c < n_; ++c)
                    for (int e = 0; e < n_; ++e) {
                        double sum = d(c, a, b, e) - d(e, a, b, c);
                        for (int f = 0; f < n_; ++f)
                            sum += gamma(a, c, f) * gamma(f, b, e) - gamma(a, e, f) * gamma(f, b, c);
                        mixed[index(a, b, c, e)] = sum;
                    }
        lower_ = std::vector<double>(mixed.size(), 0.0);
        for (int a = 0; a < n_; ++a)
            for (int b = 0; b < n_; ++b)
                for (int c = 0; c < n_; ++c)
                    for (int e = 0; e < n_; ++e)
                        for (int f = 0; f < n_; ++f) {
                            lower_[index(a, b, c, e)] += g_(a, f) * mixed[index(f, b, c, e)];
                        }
        for (double value : lower_) largest_ = std::max(largest_, std::abs(value));
    }

    /// R_abcd; indices count the coordinates of the submanifold.
    double operator()(int a, int b, int c, int d) const { return lower_[index(a, b, c, d)]; }
    const Matrix& metric() const { return g_; }
    int size() const { return n_; }
    double largest() const { return largest_; }

private:
    std::size_t index(int a, int b, int c) const { return static_cast<std::size_t>((a * n_ + b) * n_ + c); }
    std::size_t index(int a, int b, int c, int d) const {
        return static_cast<std::size_t>(((a * n_ + b) * n_ + c) * n_ + d);
    }
    std::vector<Complex> second_kind(const ComplexVector& q) {
        WorkspaceT<Complex> workspace(model_);
        const KinematicsT<Complex> kin = kinematics<Complex>(model_, q, workspace);
        ComplexMatrix g(n_, n_), first(n_, n_ * n_);
        for (int a = 0; a < n_; ++a)
            for (int b = 0; b < n_; ++b) {
                g(a, b) = lagrange::metric(kin, entry(at_, a), entry(at_, b));
                for (int c = 0; c < n_; ++c)
                    first(a, b * n_ + c) =
                        lagrange::christoffel_first_kind(kin, entry(at_, a), entry(at_, b), entry(at_, c));
            }
        g_ = g.real();
        const ComplexMatrix second = g.partialPivLu().solve(first);
        std::vector<Complex> out(static_cast<std::size_t>(n_ * n_ * n_));
        for (int a = 0; a < n_; ++a)
            for (int b = 0; b < n_; ++b)
                for (int c = 0; c < n_; ++c) out[index(a, b, c)] = second(a, b * n_ + c);
        return out;
    }

    const Model& model_;
    std::vector<int> at_;
    int n_;
    Matrix g_;
    std::vector<double> lower_;
    double largest_ = 0;
};

}  // namespace cardan::testing
