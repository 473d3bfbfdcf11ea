#include "tests/oracles/jacobi_elliptic.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace cardan::oracles {

JacobiElliptic jacobi_elliptic(double u, double k) {
    if (!(k >= 0.0 && k <= 1.0)) throw std::invalid_argument("jacobi_elliptic: modulus must lie in [0, 1]");
    if (k == 1.0) {
        const double sech = 1.0 / std::cosh(u);
        return {std::atan(std::sinh(u)), std::tanh(u), sech, sech};
    }
    constexpr std::size_t max_levels = 40;
    std::array<double, max_levels> a{};
    std::array<double, max_levels> c{};
    const double k_prime_squared = (1.0 - k) * (1.0 + k);
    a[0] = 1.0;
    c[0] = k;
    double b = std::sqrt(k_prime_squared);
    std::size_t n = 0;
    while (std::abs(c[n]) > std::numeric_limits<double>::epsilon() * a[n] && n + 1 < max_levels) {
        a[n + 1] = 0.5 * (a[n] + b);
        c[n + 1] = 0.5 * (a[n] - b);
        b = std::sqrt(a[n] * b);
        ++n;
    }
    double phi = std::ldexp(a[n] * u, static_cast<int>(n));
    for (; n > 0; --n) phi = 0.5 * (phi + std::asin(c[n] / a[n] * std::sin(phi)));
    const double cn = std::cos(phi);
    return {phi, std::sin(phi), cn, std::sqrt(k_prime_squared + k * k * cn * cn)};
}

double complete_elliptic_k(double k) {
    if (!(k >= 0.0 && k < 1.0)) throw std::invalid_argument("complete_elliptic_k: modulus must lie in [0, 1)");
    double a = 1.0;
    double b = std::sqrt((1.0 - k) * (1.0 + k));
    while (std::abs(a - b) > 2.0 * std::numeric_limits<double>::epsilon() * a) {
        const double mean = 0.5 * (a + b);
        b = std::sqrt(a * b);
        a = mean;
    }
    return std::numbers::pi / (a + b);
}

}  // namespace cardan::oracles
