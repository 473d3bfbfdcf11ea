#include "elements/aerodynamics/dynamic_inflow.hpp"

#include <algorithm>
#include <cmath>

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

double mean_induction(std::span<const double> shares, std::span<const double> axial) {
    double sum = 0, weights = 0, nearest = 0, distance = 1e300;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const double u = std::abs(shares[i] - 0.7) / 0.1, weight = std::pow(1 - std::pow(std::min(1.0, u), 2), 3);
        sum += weight * axial[i];
        weights += weight;
        if (u < distance) {
            distance = u;
            nearest = axial[i];
        }
    }
    return weights > 0 ? sum / weights : nearest;
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
