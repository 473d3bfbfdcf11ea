#include "elements/aerodynamics/dynamic_inflow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace cardan {

namespace {

constexpr double longest = 100, min_wind = 0.1;  // s, m/s

}  // namespace

InflowTimes inflow_times(double first, double share) {
    return {first, (0.39 - 0.26 * share * share) * first};
}

double inflow_time(double radius, double induction, double wind) {
    return std::min(longest, 1.1 * radius / ((1 - 1.3 * std::min(induction, 0.5)) * std::max(wind, min_wind)));
}

std::vector<double> inflow_weights(std::span<const double> shares) {
    std::vector<double> weights;
    weights.reserve(shares.size());
    double nearest = std::numeric_limits<double>::infinity();
    for (const double share : shares) {
        const double distance = std::abs(share - 0.7), u = std::min(1.0, distance / 0.1);
        weights.push_back(std::pow(1 - u * u, 3));
        nearest = std::min(nearest, distance);
    }
    if (nearest >= 0.1)
        for (std::size_t i = 0; i < shares.size(); ++i)
            weights[i] = std::abs(shares[i] - 0.7) <= nearest * (1 + 1e-9) ? 1 : 0;
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& weight : weights) weight /= sum;
    return weights;
}

Eigen::Vector2d DynamicInflow::velocity(const Induction& steady, double V_x, double V_y) {
    return {-steady.axial * V_x, steady.tangential * V_y};
}

DynamicInflow::States DynamicInflow::steady(const Eigen::Vector2d& velocity) {
    States x;
    x << (1 - kappa) * velocity, velocity;
    return x;
}

DynamicInflow::States DynamicInflow::rates(const States& x, const Eigen::Vector2d& velocity, const InflowTimes& times) {
    States out;
    out << ((1 - kappa) * velocity - x.head<2>()) / times.first,
        (x.head<2>() + kappa * velocity - x.tail<2>()) / times.second;
    return out;
}

Induction DynamicInflow::induction(const States& x, double V_x, double V_y) {
    Induction out;
    out.axial = V_x == 0 ? 0 : std::clamp(-x(axial) / V_x, -1.0, 1.5);
    out.tangential = V_y == 0 ? 0 : std::clamp(x(tangential) / V_y, -1.0, 1.0);
    out.phi = std::atan2(V_x * (1 - out.axial), V_y * (1 + out.tangential));
    return out;
}

}  // namespace cardan
