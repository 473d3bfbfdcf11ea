#include "solvers/stepper.hpp"

#include <algorithm>
#include <limits>

namespace cardan::solvers {

ErrorWeights::ErrorWeights(const EquationsOfMotion& equations, const Tolerances& tolerances)
    : relative_(tolerances.relative), absolute_(2 * Eigen::Index{equations.size()}), largest_(absolute_.size()) {
    const Eigen::Index m = equations.size();
    for (Eigen::Index i = 0; i < m; ++i) {
        const bool angle = equations.model().body(equations.unknowns()[static_cast<std::size_t>(i)]).revolute;
        absolute_(i) = angle ? tolerances.angle : tolerances.length;
        absolute_(m + i) = angle ? tolerances.angular_rate : tolerances.speed;
        largest_(i) = angle ? 1 : std::numeric_limits<double>::max();
        largest_(m + i) = std::numeric_limits<double>::max();
    }
}

void ErrorWeights::set(const double* x, double* w) const {
    for (Eigen::Index i = 0; i < absolute_.size(); ++i)
        w[i] = 1 / (absolute_(i) + relative_ * std::min(std::abs(x[i]), largest_(i)));
}

LimitingEntry limiting_entry(const double* errors, const double* weights, int size) {
    LimitingEntry largest;
    for (int i = 0; i < size; ++i)
        if (const double error = std::abs(errors[i] * weights[i]); error > largest.error) largest = {i, error};
    return largest;
}

bool Stepper::stands_still(double from, double to) {
    return to - from <= 8 * std::numeric_limits<double>::epsilon() * std::abs(to);
}

IntegrationStatistics sum(const IntegrationStatistics& earlier, const IntegrationStatistics& later) {
    IntegrationStatistics all = later;
    all.steps += earlier.steps;
    all.rejected += earlier.rejected;
    all.not_converged += earlier.not_converged;
    all.evaluations += earlier.evaluations;
    all.jacobians += earlier.jacobians;
    all.factorisations += earlier.factorisations;
    all.iterations += earlier.iterations;
    all.restarts += earlier.restarts;
    return all;
}

}  // namespace cardan::solvers
