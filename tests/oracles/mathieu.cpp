#include "tests/oracles/mathieu.hpp"

#include <cmath>
#include <numbers>

namespace cardan::oracles {

using std::numbers::pi;

double mathieu_cosine(double a, double q) {
    constexpr int rows = 3000;
    const auto beside = [&](int n) { return q / (4.0 * n * n - a); };
    // Principal minors of the tridiagonal matrix, from the first row on.
    double before = 1, now = 1;
    for (int n = -rows + 1; n <= rows; ++n) {
        const double next = now - beside(n - 1) * beside(n) * before;
        before = now;
        now = next;
    }
    const std::complex<double> sine = std::sin(pi / 2 * std::sqrt(std::complex<double>(a)));
    return 1 - 2 * now * (sine * sine).real();
}

std::complex<double> mathieu_exponent(double a, double q) {
    const double c = mathieu_cosine(a, q);
    if (c > 1) return std::acosh(c) / pi;
    if (c < -1) return {std::acosh(-c) / pi, 1};
    return {0, std::acos(c) / pi};
}

}  // namespace cardan::oracles
