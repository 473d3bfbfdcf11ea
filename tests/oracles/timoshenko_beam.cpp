#include "tests/oracles/timoshenko_beam.hpp"

#include "mbs/base/decompositions.hpp"
#include "tests/oracles/root_finding.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace cardan::oracles {
namespace {

/// Deflection, rotation and their derivatives of one solution at one end (dimensionless).
struct Solution {
    double w, dw, psi, dpsi;
};

/// The two solutions that belong to one root kappa2 of the characteristic equation, even and odd in xi:
/// W = C and W = kappa2 S, where C = cosh(kappa xi), S = sinh(kappa xi) / kappa (trigonometric if kappa2 < 0).
std::pair<Solution, Solution> solutions(double kappa2, double b2s2, double xi) {
    double c = 1.0;
    double s = xi;
    const double kappa = std::sqrt(std::abs(kappa2));
    if (kappa2 > 0.0) {
        c = std::cosh(kappa * xi);
        s = std::sinh(kappa * xi) / kappa;
    } else if (kappa2 < 0.0) {
        c = std::cos(kappa * xi);
        s = std::sin(kappa * xi) / kappa;
    }
    const double p = kappa2 + b2s2;
    return {{c, kappa2 * s, p * s, p * c}, {kappa2 * s, kappa2 * c, p * c, p * kappa2 * s}};
}

}  // namespace

TimoshenkoBeam::TimoshenkoBeam(double radius_of_gyration, double modulus_ratio)
    : r2_(radius_of_gyration * radius_of_gyration), s2_(modulus_ratio * r2_) {
    if (!(r2_ > 0.0) || !(s2_ > 0.0)) {
        throw std::invalid_argument("TimoshenkoBeam: radius of gyration and modulus ratio must be positive");
    }
}

double TimoshenkoBeam::boundary_determinant(Ends ends, double b) const {
    const double b2 = b * b;
    const double half_sum = 0.5 * b2 * (r2_ + s2_);
    const double product = -b2 * (1.0 - b2 * r2_ * s2_);
    const double root = std::sqrt(half_sum * half_sum - product);  // = sqrt((r2-s2)^2 b^4/4 + b^2) > 0
    const double kappa2_minus = -half_sum - root;
    const double kappa2_plus = product / kappa2_minus;

    Eigen::Matrix4d m;
    int column = 0;
    for (const double kappa2 : {kappa2_plus, kappa2_minus}) {
        const auto at_0 = solutions(kappa2, b2 * s2_, 0.0);
        const auto at_1 = solutions(kappa2, b2 * s2_, 1.0);
        for (const auto& [y0, y1] : {std::pair{at_0.first, at_1.first}, std::pair{at_0.second, at_1.second}}) {
            switch (ends) {
                case Ends::clamped_free:
                    m.col(column) << y0.w, y0.psi, y1.dpsi, y1.dw - y1.psi;
                    break;
                case Ends::free_free:
                    m.col(column) << y0.dpsi, y0.dw - y0.psi, y1.dpsi, y1.dw - y1.psi;
                    break;
                case Ends::hinged_hinged:
                    m.col(column) << y0.w, y0.dpsi, y1.w, y1.dpsi;
                    break;
            }
            m.col(column).normalize();
            ++column;
        }
    }
    return Eigen::MatrixXd(m).partialPivLu().determinant();
}

std::vector<double> TimoshenkoBeam::frequencies(Ends ends, int count) const {
    // Walk in beta = sqrt(b): neighbouring bending modes are about pi apart, branches may cross more closely.
    constexpr double start = 0.3;
    constexpr double step = 0.004;
    auto beta = first_zeros([&](double z) { return boundary_determinant(ends, z * z); }, start, step, count);
    for (double& z : beta) z *= z;
    return beta;
}

TimoshenkoBeam::Branches TimoshenkoBeam::hinged_hinged(int half_waves) const {
    // r^2 s^2 b^4 - (1 + k^2 (r^2 + s^2)) b^2 + k^4 = 0, k = n pi
    const double k2 = std::pow(half_waves * std::numbers::pi, 2);
    const double a = r2_ * s2_;
    const double half = 0.5 * (1.0 + k2 * (r2_ + s2_));
    const double larger = (half + std::sqrt(half * half - a * k2 * k2)) / a;
    return {k2 / std::sqrt(a * larger), std::sqrt(larger)};
}

}  // namespace cardan::oracles
