/// @file
/// Numbers with their derivatives, for formulas that are differentiated exactly.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <type_traits>

namespace cardan {

/// A value and its derivatives by N variables, the first ones or (Order = 2) the second ones as well: forward
/// differentiation [Griewank and Walther 2008, ch. 3 and 13].
///
/// Eigen's AutoDiffScalar (unsupported) is not in its place: second derivatives by nesting it are N times as many
/// gradients, and its expressions refer to temporaries that `auto` outlives.
template <int N, int Order = 1>
struct Dual {
    struct None {};
    using Slopes = Eigen::Matrix<double, N, 1>;
    using Hessian = std::conditional_t<Order == 2, Eigen::Matrix<double, N, N>, None>;

    double value = 0;
    Slopes slopes = Slopes::Zero();
    [[no_unique_address]] Hessian hessian = no_curvature();

    Dual() = default;
    Dual(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor): constants of formulas
    Dual(double value_, const Slopes& slopes_) : value(value_), slopes(slopes_) {}
    /// The variable itself.
    static Dual variable(double value, int index) {
        Dual out(value);
        out.slopes(index) = 1;
        return out;
    }
    /// f(x), given its value, slope and second derivative at x.
    Dual chain(double f, double slope, [[maybe_unused]] double curvature = 0) const {
        Dual out(f, slope * slopes);
        if constexpr (Order == 2) out.hessian = slope * hessian + curvature * slopes * slopes.transpose();
        return out;
    }

    Dual operator-() const { return chain(-value, -1); }
    friend Dual operator+(const Dual& a, const Dual& b) {
        Dual out(a.value + b.value, a.slopes + b.slopes);
        if constexpr (Order == 2) out.hessian = a.hessian + b.hessian;
        return out;
    }
    friend Dual operator-(const Dual& a, const Dual& b) {
        Dual out(a.value - b.value, a.slopes - b.slopes);
        if constexpr (Order == 2) out.hessian = a.hessian - b.hessian;
        return out;
    }
    friend Dual operator*(const Dual& a, const Dual& b) {
        Dual out(a.value * b.value, a.value * b.slopes + b.value * a.slopes);
        if constexpr (Order == 2) {
            const Hessian cross_terms = a.slopes * b.slopes.transpose();
            out.hessian = a.value * b.hessian + b.value * a.hessian + cross_terms + cross_terms.transpose();
        }
        return out;
    }
    friend Dual operator/(const Dual& a, const Dual& b) {
        static_assert(Order == 1, "nobody needs the second derivatives of a quotient");
        const double ratio = a.value / b.value;
        return {ratio, (a.slopes - ratio * b.slopes) / b.value};
    }
    Dual& operator*=(const Dual& b) { return *this = *this * b; }

private:
    static Hessian no_curvature() {
        if constexpr (Order == 2)
            return Hessian::Zero();
        else
            return {};
    }
};

template <int N, int Order>
Dual<N, Order> sin(const Dual<N, Order>& x) {
    const double s = std::sin(x.value);
    return x.chain(s, std::cos(x.value), -s);
}
template <int N, int Order>
Dual<N, Order> cos(const Dual<N, Order>& x) {
    const double c = std::cos(x.value);
    return x.chain(c, -std::sin(x.value), -c);
}
/// Sine and cosine at once.
template <class S>
struct SineCosine {
    S sine, cosine;
};
inline SineCosine<double> sine_cosine(double x) {
    return {std::sin(x), std::cos(x)};
}
template <int N>
SineCosine<Dual<N>> sine_cosine(const Dual<N>& x) {
    const double s = std::sin(x.value), c = std::cos(x.value);
    return {x.chain(s, c), x.chain(c, -s)};
}
template <int N>
Dual<N> tan(const Dual<N>& x) {
    const double t = std::tan(x.value);
    return x.chain(t, 1 + t * t);
}
template <int N>
Dual<N> exp(const Dual<N>& x) {
    const double e = std::exp(x.value);
    return x.chain(e, e);
}
template <int N>
Dual<N> sqrt(const Dual<N>& x) {
    const double root = std::sqrt(x.value);
    return x.chain(root, 0.5 / root);
}
template <int N>
Dual<N> acos(const Dual<N>& x) {
    return x.chain(std::acos(x.value), -1 / std::sqrt((1 - x.value) * (1 + x.value)));
}
template <int N>
Dual<N> abs(const Dual<N>& x) {
    return x.value < 0 ? -x : x;
}
template <int N>
Dual<N> atan2(const Dual<N>& y, const Dual<N>& x) {
    const double square = x.value * x.value + y.value * y.value;
    if (square == 0) return std::atan2(y.value, x.value);  // nothing has a direction to change
    return {std::atan2(y.value, x.value), (x.value * y.slopes - y.value * x.slopes) / square};
}

inline double value_of(double x) {
    return x;
}
template <int N>
double value_of(const Dual<N>& x) {
    return x.value;
}

}  // namespace cardan
