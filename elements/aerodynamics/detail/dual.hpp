/// @file
/// Numbers with their derivatives, for formulas that are differentiated exactly. Internal to aerodynamics: not
/// installed.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace cardan {

/// A value and its derivatives by N variables: forward differentiation [Griewank and Walther 2008, ch. 3].
template <int N>
struct Dual {
    using Slopes = Eigen::Array<double, N, 1>;

    double value = 0;
    Slopes slopes = Slopes::Zero();

    Dual() = default;
    Dual(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor): constants of formulas
    Dual(double value_, const Slopes& slopes_) : value(value_), slopes(slopes_) {}
    /// The variable itself.
    static Dual variable(double value, int index) {
        Dual out(value);
        out.slopes(index) = 1;
        return out;
    }
    /// f(x), given its value and slope at x.
    Dual chain(double f, double slope) const { return {f, slope * slopes}; }

    Dual operator-() const { return {-value, -slopes}; }
    friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.slopes + b.slopes}; }
    friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.slopes - b.slopes}; }
    friend Dual operator*(const Dual& a, const Dual& b) {
        return {a.value * b.value, a.value * b.slopes + b.value * a.slopes};
    }
    friend Dual operator/(const Dual& a, const Dual& b) {
        const double ratio = a.value / b.value;
        return {ratio, (a.slopes - ratio * b.slopes) / b.value};
    }
    Dual& operator*=(const Dual& b) { return *this = *this * b; }
};

template <int N>
Dual<N> sin(const Dual<N>& x) {
    return x.chain(std::sin(x.value), std::cos(x.value));
}
template <int N>
Dual<N> cos(const Dual<N>& x) {
    return x.chain(std::cos(x.value), -std::sin(x.value));
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
