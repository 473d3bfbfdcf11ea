#include "tests/oracles/polynomial_blade.hpp"

#include "mbs/base/decompositions.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace cardan::oracles {

namespace {

PolynomialBlade::Section between(const PolynomialBlade::Section& a, const PolynomialBlade::Section& b, double t) {
    const auto mix = [t](double u, double v) { return u + t * (v - u); };
    return {mix(a.beta, b.beta), mix(a.mass, b.mass),     mix(a.EI_flap, b.EI_flap), mix(a.EI_edge, b.EI_edge),
            mix(a.GA, b.GA),     mix(a.j_flap, b.j_flap), mix(a.j_edge, b.j_edge)};
}

// s P_i(2 s - 1), zero at the root, and its derivative by x.
std::pair<Eigen::RowVectorXd, Eigen::RowVectorXd> basis(int count, double s, double L) {
    Eigen::RowVectorXd P(count + 1), dP(count + 1);
    const double t = 2 * s - 1;
    P(0) = 1, P(1) = t, dP(0) = 0, dP(1) = 1;
    for (int k = 1; k < count; ++k) {
        P(k + 1) = ((2 * k + 1) * t * P(k) - k * P(k - 1)) / (k + 1);
        dP(k + 1) = dP(k - 1) + (2 * k + 1) * P(k);
    }
    return {s * P.head(count), (P.head(count) + 2 * s * dP.head(count)) / L};
}

}  // namespace

Eigen::VectorXd PolynomialBlade::frequencies(int degree, Rule rule, int count) const {
    const double L = stations.back();
    const int n = degree;
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(4 * n, 4 * n), M = K;
    const auto add_point = [&](double x, double weight, const Section& at) {
        const auto [p, d] = basis(n, x / L, L);
        const double c = std::cos(at.beta), s = std::sin(at.beta);
        const auto row = [&](const std::array<Eigen::RowVectorXd, 4>& parts) {
            Eigen::RowVectorXd r(4 * n);
            r << parts[0], parts[1], parts[2], parts[3];
            return r;
        };
        const Eigen::RowVectorXd z = Eigen::RowVectorXd::Zero(n);
        const auto add = [&](Eigen::MatrixXd& to, double factor, const Eigen::RowVectorXd& r) {
            to += weight * factor * r.transpose() * r;
        };
        add(K, at.EI_flap, row({z, z, c * d, s * d}));
        add(K, at.EI_edge, row({z, z, -s * d, c * d}));
        add(K, at.GA, row({d, z, z, -p}));
        add(K, at.GA, row({z, d, p, z}));
        add(M, at.mass, row({p, z, z, z}));
        add(M, at.mass, row({z, p, z, z}));
        add(M, at.j_flap, row({z, z, c * p, s * p}));
        add(M, at.j_edge, row({z, z, -s * p, c * p}));
    };
    const double g = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2)), G = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2)),
                 w = (18 + std::sqrt(30.0)) / 36, W = (18 - std::sqrt(30.0)) / 36;
    for (std::size_t i = 1; i < stations.size(); ++i) {
        const double h = stations[i] - stations[i - 1];
        const auto at = [&](double t, double weight) {
            add_point(stations[i - 1] + t * h, weight * h, between(sections[i - 1], sections[i], t));
        };
        if (rule == Rule::trapezoidal) {
            at(0, 0.5), at(1, 0.5);
            continue;
        }
        for (const auto& [place, weight] : {std::pair(g, w), std::pair(-g, w), std::pair(G, W), std::pair(-G, W)})
            at((1 + place) / 2, weight / 2);
    }
    // M x = mu K x: rotations may be without inertia.
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(M, K, Eigen::EigenvaluesOnly);
    return solver.eigenvalues().reverse().head(count).cwiseSqrt().cwiseInverse() / (2 * std::numbers::pi);
}

}  // namespace cardan::oracles
