#include "tests/oracles/lateral_buckling.hpp"

#include "tests/oracles/elastica.hpp"
#include "tests/oracles/root_finding.hpp"

#include <Eigen/Core>

#include <cmath>
#include <numbers>

namespace cardan::oracles::lateral_buckling {

double tip_force() {
    // J_{-1/4}(z) = (z/2)^{-1/4} / Gamma(3/4) times sum_k (-z^2/4)^k / (k! (3/4)_k); z = P/2.
    const auto series = [](double P) {
        double term = 1.0;
        double sum = 1.0;
        for (int k = 1; k < 40; ++k) {
            term *= -(P * P / 16.0) / (k * (k - 0.25));
            sum += term;
        }
        return sum;
    };
    return bisect(series, 3.0, 5.0);
}

double tip_force_with_deflection(double EI_y, double GJ) {
    using State = Eigen::Matrix<double, 5, 1>;  // slope and moment of the elastica, then (n_y, m_x, m_z)
    const auto force_at_root = [&](double P) {
        // By arc length from the tip; the elastica bends toward the force, by a rotation about y.
        const auto f = [&](const State& s) {
            const double n_x = P * std::sin(s(0)), n_z = -P * std::cos(s(0));
            const double k_x = s(3) / GJ, k_y = s(1) / EI_y, k_z = s(4);
            State d;
            d << k_y, n_z, k_x * n_z - k_z * n_x, k_z * s(1) - k_y * s(4), k_y * s(3) - k_x * s(1) - s(2);
            return State(-d);
        };
        constexpr int steps = 2000;
        constexpr double h = 1.0 / steps;
        State y;
        y << elastica::under_dead_force({0, P / EI_y}).theta, 0, 1, 0, 0;
        for (int i = 0; i < steps; ++i) {
            const State k1 = f(y), k2 = f(y + h / 2 * k1), k3 = f(y + h / 2 * k2), k4 = f(y + h * k3);
            y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        }
        return y(2);
    };
    const double scale = std::sqrt(GJ);
    return bisect(force_at_root, 3.0 * scale, 6.0 * scale);
}

double quasi_tangential_moment() {
    return std::numbers::pi / 2;
}

double semi_tangential_moment() {
    return std::numbers::pi;
}

}  // namespace cardan::oracles::lateral_buckling
