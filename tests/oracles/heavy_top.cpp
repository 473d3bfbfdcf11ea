#include "tests/oracles/heavy_top.hpp"

#include "tests/oracles/jacobi_elliptic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace cardan::oracles {
namespace {

/// The three real roots of u^3 + a u^2 + b u + c, rising (Viete's trigonometric solution, polished by Newton steps).
std::array<double, 3> three_real_roots(double a, double b, double c) {
    const double p = std::max(0.0, a * a / 9.0 - b / 3.0);
    const double q = a * a * a / 27.0 - a * b / 6.0 + 0.5 * c;
    const double scale = std::sqrt(p);
    const double argument = scale > 0.0 ? std::clamp(-q / (p * scale), -1.0, 1.0) : 0.0;
    const double angle = std::acos(argument) / 3.0;
    std::array<double, 3> roots{};
    for (std::size_t i = 0; i < 3; ++i) {
        double u = 2.0 * scale * std::cos(angle - 2.0 * std::numbers::pi * static_cast<double>(i) / 3.0) - a / 3.0;
        for (int step = 0; step < 3; ++step) {
            const double slope = (3.0 * u + 2.0 * a) * u + b;
            if (std::abs(slope) < 1e-6 * (1.0 + std::abs(b))) break;  // double root: Newton would only add noise
            u -= (((u + a) * u + b) * u + c) / slope;
        }
        roots[i] = u;
    }
    std::sort(roots.begin(), roots.end());
    return roots;
}

}  // namespace

HeavySymmetricTop::HeavySymmetricTop(double transverse, double axial, double weight_moment)
    : a_(transverse), c_(axial), mgl_(weight_moment) {
    if (!(transverse > 0.0) || !(axial > 0.0) || !(weight_moment > 0.0)) {
        throw std::invalid_argument("HeavySymmetricTop: inertias and weight moment must be positive");
    }
}

std::optional<HeavySymmetricTop::SteadyPrecession> HeavySymmetricTop::steady_precession(double theta,
                                                                                        double omega3) const {
    const double h = c_ * omega3;
    const double ac = a_ * std::cos(theta);
    const double discriminant = h * h - 4.0 * ac * mgl_;
    if (discriminant < 0.0 || (h == 0.0 && ac >= 0.0)) return std::nullopt;
    const double sum = h + std::copysign(std::sqrt(discriminant), h);  // never cancels
    const double fast = ac == 0.0 ? std::copysign(std::numeric_limits<double>::infinity(), h) : sum / (2.0 * ac);
    return SteadyPrecession{2.0 * mgl_ / sum, fast};
}

double HeavySymmetricTop::min_spin(double theta) const {
    return 2.0 * std::sqrt(a_ * mgl_ * std::max(0.0, std::cos(theta))) / c_;
}

HeavySymmetricTop::Conserved HeavySymmetricTop::conserved(const State& s) const {
    const double sine = std::sin(s.theta);
    const double cosine = std::cos(s.theta);
    const double axial = c_ * s.omega3;
    return {0.5 * a_ * (s.theta_dot * s.theta_dot + s.psi_dot * s.psi_dot * sine * sine) +
                0.5 * c_ * s.omega3 * s.omega3 + mgl_ * cosine,
            a_ * s.psi_dot * sine * sine + axial * cosine, axial};
}

double HeavySymmetricTop::precession_rate(const Conserved& constants, double theta) const {
    const double sine = std::sin(theta);
    return (constants.vertical_momentum - constants.axial_momentum * std::cos(theta)) / (a_ * sine * sine);
}

HeavySymmetricTop::Nutation HeavySymmetricTop::nutation(const State& state) const {
    // u'^2 = (1 - u^2)(alpha - beta u) - (b - a u)^2, u = cos(theta)   [Goldstein et al., eq. 5.62']
    const Conserved constants = conserved(state);
    const double a = constants.axial_momentum / a_;
    const double b = constants.vertical_momentum / a_;
    const double alpha = 2.0 * (constants.energy - 0.5 * c_ * state.omega3 * state.omega3) / a_;
    const double beta = 2.0 * mgl_ / a_;
    const auto u = three_real_roots(-(alpha + a * a) / beta, (2.0 * a * b - beta) / beta, (alpha - b * b) / beta);
    const double spread = u[2] - u[0];
    return {u[0], u[1], 0.5 * std::sqrt(beta * spread), std::sqrt((u[1] - u[0]) / spread)};
}

double HeavySymmetricTop::Nutation::period() const {
    return 2.0 * complete_elliptic_k(modulus) / rate;
}

double HeavySymmetricTop::Nutation::cos_theta(double time) const {
    const double sn = jacobi_elliptic(rate * time, modulus).sn;
    return lower + (upper - lower) * sn * sn;
}

}  // namespace cardan::oracles
