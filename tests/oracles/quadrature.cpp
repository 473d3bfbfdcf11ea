#include "tests/oracles/quadrature.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace cardan::oracles {

Eigen::VectorXd legendre(int degree, double x) {
    Eigen::VectorXd p(degree + 1);
    p[0] = 1.0;
    if (degree > 0) p[1] = x;
    for (int n = 1; n < degree; ++n) p[n + 1] = ((2 * n + 1) * x * p[n] - n * p[n - 1]) / (n + 1);
    return p;
}

GaussRule gauss_legendre(int n) {
    if (n < 1) throw std::invalid_argument("gauss_legendre: at least one point");
    GaussRule rule{Eigen::VectorXd(n), Eigen::VectorXd(n)};
    for (int i = 0; i < n; ++i) {
        double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
        double slope = 1.0;
        for (int iteration = 0; iteration < 20; ++iteration) {
            const Eigen::VectorXd p = legendre(n, x);
            slope = n * (x * p[n] - p[n - 1]) / (x * x - 1.0);
            const double step = p[n] / slope;
            x -= step;
            if (std::abs(step) < 1e-16) break;
        }
        rule.point[i] = x;
        rule.weight[i] = 2.0 / ((1.0 - x * x) * slope * slope);
    }
    return rule;
}

namespace {

/// Q_ij = int_{-1}^{xi_i} l_j dxi, l_j the Lagrange polynomial of node j, by expansion in Legendre polynomials.
Eigen::MatrixXd integrated_lagrange(const GaussRule& rule) {
    const int n = static_cast<int>(rule.point.size());
    Eigen::MatrixXd q = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i < n; ++i) {
        const Eigen::VectorXd at_i = legendre(n, rule.point[i]);
        for (int j = 0; j < n; ++j) {
            const Eigen::VectorXd at_j = legendre(n, rule.point[j]);
            double sum = 0.5 * (1.0 + rule.point[i]);
            for (int m = 1; m < n; ++m) sum += 0.5 * at_j[m] * (at_i[m + 1] - at_i[m - 1]);
            q(i, j) = rule.weight[j] * sum;
        }
    }
    return q;
}

}  // namespace

PiecewiseGaussGrid::PiecewiseGaussGrid(const Eigen::VectorXd& breaks, int points_per_interval)
    : breaks_(breaks), rule_(gauss_legendre(points_per_interval)) {
    if (breaks.size() < 2) throw std::invalid_argument("PiecewiseGaussGrid: at least two break points");
    if (points_per_interval < 2) throw std::invalid_argument("PiecewiseGaussGrid: at least two points per interval");
    const Eigen::Index m = points_per_interval;
    const Eigen::Index n = intervals() * m;
    x_.resize(n);
    w_.resize(n);
    running_ = Eigen::MatrixXd::Zero(n, n);
    const Eigen::MatrixXd inside = integrated_lagrange(rule_);
    for (Eigen::Index e = 0; e < intervals(); ++e) {
        const double h = half_width(e);
        if (!(h > 0.0)) throw std::invalid_argument("PiecewiseGaussGrid: break points must rise");
        x_.segment(e * m, m) = breaks_[e] + h * (rule_.point.array() + 1.0);
        w_.segment(e * m, m) = h * rule_.weight;
        running_.block(e * m, e * m, m, m) = h * inside;
        for (Eigen::Index before = 0; before < e; ++before) {
            running_.block(e * m, before * m, m, m).rowwise() = w_.segment(before * m, m).transpose();
        }
    }
}

Eigen::VectorXd PiecewiseGaussGrid::integral_to_the_right(const Eigen::VectorXd& f) const {
    const Eigen::VectorXd left = running_ * f;
    return Eigen::VectorXd::Constant(size(), w_.dot(f)) - left;
}

}  // namespace cardan::oracles
