#pragma once

#include <Eigen/Core>

#include <cmath>

namespace cardan::oracles {

/// Truncated Taylor series of second order in N local variables: value, gradient and Hessian carried through products,
/// sines and cosines. So energies are written once and their exact first and second derivatives come along.
/// [Griewank and Walther, Evaluating Derivatives, 2008, chapter 13]
template <int N>
struct Jet {
    using Gradient = Eigen::Matrix<double, N, 1>;
    using Hessian = Eigen::Matrix<double, N, N>;

    double value = 0.0;
    Gradient gradient = Gradient::Zero();
    Hessian hessian = Hessian::Zero();

    Jet() = default;
    Jet(double constant) : value(constant) {}  // NOLINT: a number is a jet without derivatives

    static Jet variable(double at, int index) {
        Jet x(at);
        x.gradient[index] = 1.0;
        return x;
    }

    /// f(x) from f, f', f'' at x.
    Jet chain(double f, double df, double ddf) const {
        Jet y(f);
        y.gradient = df * gradient;
        y.hessian = df * hessian + ddf * gradient * gradient.transpose();
        return y;
    }

    friend Jet operator+(const Jet& a, const Jet& b) {
        Jet y(a.value + b.value);
        y.gradient = a.gradient + b.gradient;
        y.hessian = a.hessian + b.hessian;
        return y;
    }
    friend Jet operator*(const Jet& a, const Jet& b) {
        Jet y(a.value * b.value);
        y.gradient = a.value * b.gradient + b.value * a.gradient;
        const Hessian cross = a.gradient * b.gradient.transpose();
        y.hessian = a.value * b.hessian + b.value * a.hessian + cross + cross.transpose();
        return y;
    }
    friend Jet operator-(const Jet& a) { return a.chain(-a.value, -1.0, 0.0); }
    friend Jet operator-(const Jet& a, const Jet& b) { return a + (-b); }
    friend Jet sin(const Jet& a) { return a.chain(std::sin(a.value), std::cos(a.value), -std::sin(a.value)); }
    friend Jet cos(const Jet& a) { return a.chain(std::cos(a.value), -std::sin(a.value), -std::cos(a.value)); }
};

}  // namespace cardan::oracles
