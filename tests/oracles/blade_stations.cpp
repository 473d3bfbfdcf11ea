#include "tests/oracles/blade_stations.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace cardan::oracles {

BladeStations::BladeStations(std::vector<BladeStation> stations) : stations_(std::move(stations)) {
    if (stations_.size() < 2 || stations_.front().x != 0.0) {
        throw std::invalid_argument("BladeStations: at least two stations, the first at x = 0");
    }
    for (std::size_t i = 1; i < stations_.size(); ++i) {
        if (!(stations_[i].x > stations_[i - 1].x)) throw std::invalid_argument("BladeStations: x must rise");
    }
}

BladeStation BladeStations::at(double x) const {
    const auto last = std::prev(stations_.end());
    const auto right = std::clamp(
        std::upper_bound(stations_.begin(), stations_.end(), x, [](double v, const auto& s) { return v < s.x; }),
        std::next(stations_.begin()), last);
    const BladeStation& a = *std::prev(right);
    const BladeStation& b = *right;
    const double t = (x - a.x) / (b.x - a.x);
    const auto linear = [&](double BladeStation::*p) { return (1.0 - t) * a.*p + t * b.*p; };
    const auto log_linear = [&](double BladeStation::*p) {
        return std::exp((1.0 - t) * std::log(a.*p) + t * std::log(b.*p));
    };
    return {.x = x,
            .mass_per_length = linear(&BladeStation::mass_per_length),
            .flap_stiffness = log_linear(&BladeStation::flap_stiffness),
            .edge_stiffness = log_linear(&BladeStation::edge_stiffness),
            .torsion_stiffness = log_linear(&BladeStation::torsion_stiffness),
            .twist = linear(&BladeStation::twist),
            .mass_centre_offset = linear(&BladeStation::mass_centre_offset),
            .shear_centre_offset = linear(&BladeStation::shear_centre_offset),
            .polar_inertia = linear(&BladeStation::polar_inertia)};
}

Eigen::VectorXd BladeStations::positions() const {
    Eigen::VectorXd x(static_cast<Eigen::Index>(stations_.size()));
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = stations_[static_cast<std::size_t>(i)].x;
    return x;
}

double BladeStations::mass() const {
    double sum = 0.0;
    for (std::size_t i = 1; i < stations_.size(); ++i) {
        sum += 0.5 * (stations_[i].x - stations_[i - 1].x) *
               (stations_[i].mass_per_length + stations_[i - 1].mass_per_length);
    }
    return sum;
}

}  // namespace cardan::oracles
