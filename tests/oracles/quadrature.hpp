#pragma once

#include <Eigen/Core>

namespace cardan::oracles {

/// Nodes and weights of an n-point rule on [-1, 1] (dimensionless).
struct GaussRule {
    Eigen::VectorXd point;
    Eigen::VectorXd weight;
};

/// Legendre polynomials P_0 .. P_degree at x in [-1, 1].   [Abramowitz and Stegun 1964, 22.7.10]
Eigen::VectorXd legendre(int degree, double x);

/// Gauss-Legendre rule, exact for polynomials up to degree 2n - 1; nodes by Newton's method on P_n.
/// [Abramowitz and Stegun 1964, 25.4.29]
GaussRule gauss_legendre(int n);

/// A Gauss rule on each interval of a partition of [a, b], strung together in rising order, and the matrix of the
/// running integral from the left end: (C f)_i = int_a^{x_i} f dx for values f given at the points, exact if f is a
/// polynomial of degree below points_per_interval on every interval (spectral integration of its interpolant).
/// Kinks and jumps of the integrand are allowed at the break points.
class PiecewiseGaussGrid {
public:
    /// @param breaks              rising, at least two, unit of length of the caller
    /// @param points_per_interval at least 2
    PiecewiseGaussGrid(const Eigen::VectorXd& breaks, int points_per_interval);

    const Eigen::VectorXd& breaks() const { return breaks_; }
    const GaussRule& rule() const { return rule_; }
    Eigen::Index intervals() const { return breaks_.size() - 1; }
    Eigen::Index size() const { return x_.size(); }
    Eigen::Index points_per_interval() const { return rule_.point.size(); }
    double half_width(Eigen::Index interval) const { return 0.5 * (breaks_[interval + 1] - breaks_[interval]); }

    const Eigen::VectorXd& points() const { return x_; }
    const Eigen::VectorXd& weights() const { return w_; }
    const Eigen::MatrixXd& running_integral() const { return running_; }

    /// int_{x_i}^b f dx for all points x_i.
    Eigen::VectorXd integral_to_the_right(const Eigen::VectorXd& f) const;

private:
    Eigen::VectorXd breaks_;
    GaussRule rule_;
    Eigen::VectorXd x_;
    Eigen::VectorXd w_;
    Eigen::MatrixXd running_;
};

}  // namespace cardan::oracles
