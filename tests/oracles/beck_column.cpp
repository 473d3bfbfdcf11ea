#include "tests/oracles/beck_column.hpp"

#include "mbs/base/decompositions.hpp"
#include "tests/oracles/root_finding.hpp"

#include <cmath>

namespace cardan::oracles::beck_column {

namespace {

struct WaveNumbers {
    double a, b;
};
WaveNumbers wave_numbers(double force, double omega) {
    const double root = std::sqrt(force * force / 4 + omega * omega);
    return {std::sqrt(root + force / 2), std::sqrt(root - force / 2)};
}

// Between the first two frequencies the function has a minimum; golden section.
double lowest_place(double force) {
    const double g = (std::sqrt(5.0) - 1) / 2;
    double a = 5, b = 22;
    while (b - a > 1e-9) {
        const double c = b - g * (b - a), d = a + g * (b - a);
        if (frequency_equation(force, c) < frequency_equation(force, d))
            b = d;
        else
            a = c;
    }
    return (a + b) / 2;
}

}  // namespace

double frequency_equation(double force, double omega) {
    const auto [a, b] = wave_numbers(force, omega);
    return force * force + 2 * omega * omega * (1 + std::cos(a) * std::cosh(b)) +
           force * omega * std::sin(a) * std::sinh(b);
}

double boundary_determinant(double force, double omega) {
    const auto [a, b] = wave_numbers(force, omega);
    Eigen::Matrix4d rows;  // columns: cos, sin, cosh, sinh
    rows << 1, 0, 1, 0,    //
        0, a, 0, b,        //
        -a * a * std::cos(a), -a * a * std::sin(a), b * b * std::cosh(b), b * b * std::sinh(b), a * a * a * std::sin(a),
        -a * a * a * std::cos(a), b * b * b * std::sinh(b), b * b * b * std::cosh(b);
    return rows.determinant();
}

Frequencies frequencies(double force) {
    const double between = lowest_place(force);
    const auto f = [&](double omega) { return frequency_equation(force, omega); };
    return {bisect(f, 1e-3, between), bisect(f, between, 30.0)};
}

Flutter flutter() {
    const double force = bisect([](double P) { return frequency_equation(P, lowest_place(P)); }, 10.0, 25.0);
    return {force, lowest_place(force)};
}

// (1 + eta lambda) y'''' + P y'' + lambda^2 y = 0 has the frequency equation of the undamped column with P and W
// divided by 1 + eta lambda; its first variation in eta.
Flutter flutter_with_vanishing_damping() {
    const auto growth = [](double force) {
        constexpr double h = 1e-4;
        const double omega = frequencies(force).first, W = omega * omega;
        const auto F = [](double P, double w2) { return frequency_equation(P, std::sqrt(w2)); };
        const double by_force = (F(force + h, W) - F(force - h, W)) / (2 * h);
        const double by_W = (F(force, W + h) - F(force, W - h)) / (2 * h);
        return -W / 2 - force * by_force / (2 * by_W);
    };
    const double force = bisect(growth, 1.0, 19.5);
    return {force, frequencies(force).first};
}

}  // namespace cardan::oracles::beck_column
