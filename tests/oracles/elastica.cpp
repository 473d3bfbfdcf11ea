#include "tests/oracles/elastica.hpp"

#include "tests/oracles/root_finding.hpp"

#include <cmath>
#include <numbers>

namespace cardan::oracles::elastica {

namespace {

// (theta, M, x, y) by arc length counted from the tip toward the root, in the axes of the tip section.
using State = Eigen::Vector4d;

State derivative(const State& s, const Eigen::Vector2d& force) {
    const double c = std::cos(s(0)), d = std::sin(s(0));
    return {-s(1), -(force.x() * d - force.y() * c), -c, -d};
}

State root_seen_from_tip(const Eigen::Vector2d& force) {
    constexpr int steps = 4000;
    constexpr double h = 1.0 / steps;
    State s = State::Zero();
    for (int i = 0; i < steps; ++i) {
        const State k1 = derivative(s, force);
        const State k2 = derivative(s + h / 2 * k1, force);
        const State k3 = derivative(s + h / 2 * k2, force);
        const State k4 = derivative(s + h * k3, force);
        s += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return s;
}

Eigen::Vector2d turned(const Eigen::Vector2d& v, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

}  // namespace

Tip under_moment(double moment) {
    if (moment == 0) return {1, 0, 0};
    return {std::sin(moment) / moment, (1 - std::cos(moment)) / moment, moment};
}

Tip under_follower_force(const Eigen::Vector2d& force) {
    const State root = root_seen_from_tip(force);
    const double theta = -root(0);
    const Eigen::Vector2d tip = turned(Eigen::Vector2d(-root(2), -root(3)), theta);
    return {tip.x(), tip.y(), theta};
}

Tip under_dead_force(const Eigen::Vector2d& force) {
    const auto mismatch = [&](double theta) { return under_follower_force(turned(force, -theta)).theta - theta; };
    const double theta = bisect(mismatch, 0.0, std::atan2(force.y(), force.x()));
    Tip tip = under_follower_force(turned(force, -theta));
    tip.theta = theta;
    return tip;
}

// theta(s) from the first integral theta'^2 / 2 = F (sin theta_tip - sin theta), with 1 + sin theta = 2 k^2 sin^2 phi.
Tip under_transverse_force(double force) {
    const double root = std::sqrt(force);
    const auto modulus = [](double theta) { return std::sqrt((1 + std::sin(theta)) / 2); };
    const auto lower = [](double k) { return std::asin(1 / (k * std::numbers::sqrt2)); };
    const auto length = [&](double theta) {
        const double k = modulus(theta);
        return std::comp_ellint_1(k) - std::ellint_1(k, lower(k)) - root;
    };
    const double theta = bisect(length, 1e-9, std::numbers::pi / 2 - 1e-6);  // modulus below 1
    const double k = modulus(theta);
    const double E = std::comp_ellint_2(k) - std::ellint_2(k, lower(k));
    return {std::sqrt(2 * std::sin(theta)) / root, 1 - 2 * E / root, theta};
}

}  // namespace cardan::oracles::elastica
