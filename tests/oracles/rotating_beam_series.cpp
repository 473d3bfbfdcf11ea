#include "tests/oracles/rotating_beam_series.hpp"

#include "tests/oracles/root_finding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cardan::oracles {

double RotatingBeamSeries::root_determinant(double lambda) const {
    using Real = long double;
    const Real eta2 = static_cast<Real>(eta) * static_cast<Real>(eta);
    const Real reach = 1.0L + static_cast<Real>(hub_radius);
    const Real lambda_l = lambda;
    constexpr int max_terms = 2000;

    // Deflection and the second condition (slope or curvature) at z = 1, for the series that starts with 1 and with z.
    std::array<std::array<Real, 2>, 2> at_root{};
    for (std::size_t start = 0; start < 2; ++start) {
        std::array<Real, 4> a{};  // a_n .. a_{n+3}
        a[start] = 1.0L;
        Real w = 1.0L;
        Real slope = static_cast<Real>(start);
        Real curvature = 0.0L;
        int small = 0;
        for (int n = 0; n < max_terms && small < 8; ++n) {
            const Real k = n;
            const Real right = eta2 * (reach * (k + 1) * (k + 1) * a[1] - 0.5L * k * (k + 1) * a[0]) + lambda_l * a[0];
            const Real next = right / ((k + 1) * (k + 2) * (k + 3) * (k + 4));
            a = {a[1], a[2], a[3], next};
            const Real power = k + 4;
            w += next;
            slope += power * next;
            curvature += power * (power - 1) * next;
            const bool tiny = std::abs(power * power * next) < std::numeric_limits<Real>::epsilon() * std::abs(w);
            small = tiny ? small + 1 : 0;
        }
        at_root[start] = {w, hinged ? curvature : slope};
    }
    const Real size = std::abs(at_root[0][0] * at_root[1][1]) + std::abs(at_root[1][0] * at_root[0][1]);
    return static_cast<double>((at_root[0][0] * at_root[1][1] - at_root[1][0] * at_root[0][1]) / size);
}

std::vector<double> RotatingBeamSeries::flap(int count) const {
    return first_zeros([&](double b) { return root_determinant(b * b); }, hinged ? 0.05 + 0.5 * eta : 0.05, 0.05,
                       count);
}

std::vector<double> RotatingBeamSeries::lag(int count) const {
    std::vector<double> b = flap(count);
    for (double& value : b) value = std::sqrt(std::max(0.0, value * value - eta * eta));
    return b;
}

}  // namespace cardan::oracles
