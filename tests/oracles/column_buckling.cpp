#include "tests/oracles/column_buckling.hpp"

#include "tests/oracles/root_finding.hpp"

#include <cmath>
#include <numbers>

namespace cardan::oracles::column_buckling {

double clamped_free() {
    return 0.25 * std::numbers::pi * std::numbers::pi;
}

double hinged_hinged() {
    return std::numbers::pi * std::numbers::pi;
}

double clamped_free_own_weight() {
    // J_{-1/3}(x) = x^{-1/3} times the series sum_k (-x^2/4)^k / (k! Gamma(k + 2/3)), and x^2/4 = q/9, q = qL^3/EI.
    const auto series = [](double q) {
        double term = 1.0;
        double sum = 1.0;
        for (int k = 1; k < 40; ++k) {
            term *= -(q / 9.0) / (k * (k - 1.0 / 3.0));
            sum += term;
        }
        return sum;
    };
    return bisect(series, 5.0, 10.0);
}

}  // namespace cardan::oracles::column_buckling
