#include "tests/oracles/strip_flutter.hpp"

#include "mbs/base/decompositions.hpp"
#include "tests/oracles/euler_bernoulli.hpp"
#include "tests/oracles/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

namespace cardan::oracles {

using std::numbers::pi;
using Complex = std::complex<double>;

std::complex<double> theodorsen(double k) {
    const Complex H0(std::cyl_bessel_j(0, k), -std::cyl_neumann(0, k)),
        H1(std::cyl_bessel_j(1, k), -std::cyl_neumann(1, k));
    return H1 / (H1 + Complex(0, 1) * H0);
}

std::complex<double> TwoLags::operator()(double k) const {
    const Complex ik(0, k);
    return 1.0 - A[0] * ik / (ik + b[0]) - A[1] * ik / (ik + b[1]);
}

StripShapes cantilever_shapes(double length, double EI, double GJ, int count) {
    const GaussRule rule = gauss_legendre(60);
    const Eigen::Index points = rule.point.size();
    // Bending shapes are 1 at the tip, where their square integrates to 1/4 of the length.
    Eigen::MatrixXd phi(count, points), psi(count, points);
    StripShapes out;
    out.plunge_stiffness = out.pitch_stiffness = Eigen::MatrixXd::Zero(count, count);
    for (int i = 0; i < count; ++i) {
        const double beta = euler_bernoulli::cantilever_wave_number(i + 1), gamma = (i + 0.5) * pi;
        for (Eigen::Index j = 0; j < points; ++j) {
            const double xi = (1 + rule.point(j)) / 2;
            phi(i, j) = euler_bernoulli::cantilever_shape(i + 1, xi);
            psi(i, j) = std::sin(gamma * xi);
        }
        out.plunge_stiffness(i, i) = EI * std::pow(beta, 4) / std::pow(length, 3) / 4;
        out.pitch_stiffness(i, i) = GJ * gamma * gamma / length / 2;
    }
    out.plunge = length / 4 * Eigen::MatrixXd::Identity(count, count);
    out.pitch = length / 2 * Eigen::MatrixXd::Identity(count, count);
    out.mixed = length / 2 * phi * rule.weight.asDiagonal() * psi.transpose();
    return out;
}

StripShapes section_shapes(double plunge_stiffness, double pitch_stiffness) {
    const auto one = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
    return {one(1), one(1), one(1), one(plunge_stiffness), one(pitch_stiffness)};
}

StripFlutter::StripFlutter(const Strip& strip, StripShapes shapes) : strip_(strip), shapes_(std::move(shapes)) {}

template <class S>
Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> StripFlutter::over_shapes(S hh, S ha, S ah, S aa) const {
    const Eigen::Index n = shapes_.plunge.rows(), m = shapes_.pitch.rows();
    Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> out(n + m, n + m);
    out << hh * shapes_.plunge.cast<S>(), ha * shapes_.mixed.cast<S>(), ah * shapes_.mixed.transpose().cast<S>(),
        aa * shapes_.pitch.cast<S>();
    return out;
}

Eigen::MatrixXd StripFlutter::mass() const {
    return over_shapes<double>(strip_.mass, strip_.static_moment, strip_.static_moment, strip_.inertia);
}

Eigen::MatrixXd StripFlutter::stiffness() const {
    const Eigen::Index n = shapes_.plunge.rows(), m = shapes_.pitch.rows();
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n + m, n + m);
    K.topLeftCorner(n, n) = shapes_.plunge_stiffness;
    K.bottomRightCorner(m, m) = shapes_.pitch_stiffness;
    return K;
}

Eigen::VectorXd StripFlutter::frequencies() const {
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness(), mass());
    return solver.eigenvalues().cwiseSqrt();
}

// mu of all motions. Forces over omega^2, d/dt = i omega, U = omega b / k.
Eigen::VectorXcd StripFlutter::at_reduced_frequency(const Deficiency& C, double k) const {
    const double b = strip_.half_chord, a = strip_.axis, U = b / k, air = pi * strip_.density;
    const Complex s(0, 1), circulation = 2 * air * U * b * C(k), w_h = s, w_a = U + b * (0.5 - a) * s;
    const Complex lift_h = air * b * b * s * s + circulation * w_h,
                  lift_a = air * b * b * (U * s - b * a * s * s) + circulation * w_a,
                  moment_h = air * b * b * b * a * s * s + b * (a + 0.5) * circulation * w_h,
                  moment_a = air * b * b * (-U * b * (0.5 - a) * s - b * b * (0.125 + a * a) * s * s) +
                             b * (a + 0.5) * circulation * w_a;
    // omega^2 M x - K x = (L, -M) with L, M per omega^2.
    const Eigen::MatrixXcd inertial =
        mass().cast<Complex>() - over_shapes<Complex>(lift_h, lift_a, -moment_h, -moment_a);
    const Eigen::MatrixXcd compliance = stiffness().diagonal().cwiseInverse().cast<Complex>().asDiagonal();
    const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(Eigen::MatrixXcd(compliance * inertial), false);
    return solver.eigenvalues();
}

FlutterPoint StripFlutter::flutter(const Deficiency& C, double largest_frequency, double min_k) const {
    constexpr double step = 0.002;
    const auto nearest = [](const Eigen::VectorXcd& values, Complex wanted) {
        return *std::min_element(values.begin(), values.end(),
                                 [&](Complex x, Complex y) { return std::abs(x - wanted) < std::abs(y - wanted); });
    };
    std::vector<FlutterPoint> found;
    Eigen::VectorXcd before = at_reduced_frequency(C, 2.5);
    for (double k = 2.5 - step; k > min_k; k -= step) {
        const Eigen::VectorXcd now = at_reduced_frequency(C, k);
        for (const Complex mu : before) {
            const Complex next = nearest(now, mu);
            if ((mu.imag() > 0) == (next.imag() > 0) || !(next.real() > 0)) continue;
            double low = k, high = k + step;
            Complex at_low = next, at_high = mu;
            for (int i = 0; i < 60; ++i) {
                const double middle = (low + high) / 2;
                const Complex at = nearest(at_reduced_frequency(C, middle), (at_low + at_high) / 2.0);
                const bool below = (at.imag() > 0) == (at_low.imag() > 0);
                (below ? low : high) = middle;
                (below ? at_low : at_high) = at;
            }
            const double omega = 1 / std::sqrt(at_low.real());
            if (omega < largest_frequency) found.push_back({omega * strip_.half_chord / low, omega});
        }
        before = now;
    }
    if (found.empty()) throw std::runtime_error("strip flutter: no flutter in the range of reduced frequencies");
    return *std::min_element(found.begin(), found.end(),
                             [](const FlutterPoint& x, const FlutterPoint& y) { return x.speed < y.speed; });
}

// States z_i' = w - b_i (U/b) z_i over the shapes of h and alpha each; C w = (1 - sum A_i) w + sum A_i b_i (U/b) z_i.
Eigen::VectorXcd StripFlutter::eigenvalues(const TwoLags& C, double speed) const {
    const double b = strip_.half_chord, a = strip_.axis, U = speed, air = pi * strip_.density;
    const Eigen::Index n = shapes_.plunge.rows(), N = n + shapes_.pitch.rows();
    const double circulation = 2 * air * U * b, lever = b * (a + 0.5), arm = b * (0.5 - a);
    const Eigen::MatrixXd M = mass() + air * b * b * over_shapes<double>(1, -b * a, -b * a, b * b * (0.125 + a * a));
    // Lift per w carried by a shape of h or of alpha.
    const Eigen::MatrixXd carried = circulation * over_shapes<double>(1, 1, -lever, -lever);
    Eigen::VectorXd from_rate(N), from_angle = Eigen::VectorXd::Zero(N);
    from_rate << Eigen::VectorXd::Ones(n), Eigen::VectorXd::Constant(N - n, arm);
    from_angle.tail(N - n).setConstant(U);
    const double at_once = 1 - C.A[0] - C.A[1];
    const Eigen::MatrixXd damping = air * b * b * U * over_shapes<double>(0, 1, 0, b * (0.5 - a)) +
                                    at_once * carried * from_rate.asDiagonal(),
                          K = stiffness() + at_once * carried * from_angle.asDiagonal();
    const Eigen::LLT<Eigen::MatrixXd> inverse(M);
    Eigen::MatrixXd S = Eigen::MatrixXd::Zero(4 * N, 4 * N);
    S.block(0, N, N, N).setIdentity();
    S.block(N, 0, N, N) = -inverse.solve(K);
    S.block(N, N, N, N) = -inverse.solve(damping);
    for (Eigen::Index i = 0; i < 2; ++i) {
        const double rate = C.b[static_cast<std::size_t>(i)] * U / b;
        const Eigen::Index z = (2 + i) * N;
        S.block(N, z, N, N) = -C.A[static_cast<std::size_t>(i)] * rate * inverse.solve(carried);
        S.block(z, 0, N, N) = from_angle.asDiagonal();
        S.block(z, N, N, N) = from_rate.asDiagonal();
        S.block(z, z, N, N).diagonal().setConstant(-rate);
    }
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(S, false);
    std::vector<Complex> upper;
    for (const Complex value : solver.eigenvalues())
        if (value.imag() > 0) upper.push_back(value);
    std::sort(upper.begin(), upper.end(), [](Complex x, Complex y) { return x.imag() < y.imag(); });
    return Eigen::Map<const Eigen::VectorXcd>(upper.data(), static_cast<Eigen::Index>(upper.size()));
}

FlutterPoint StripFlutter::steady_flutter(double largest_speed) const {
    const double b = strip_.half_chord, lever = b * (strip_.axis + 0.5);
    const Eigen::LLT<Eigen::MatrixXd> inverse(mass());
    // The squares of the frequencies; complex from flutter on.
    const auto squares = [&](double speed) {
        const double lift = 2 * pi * strip_.density * speed * speed * b;
        const Eigen::MatrixXd K = stiffness() + over_shapes<double>(0, lift, 0, -lift * lever);
        return Eigen::VectorXcd(
            Eigen::EigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(inverse.solve(K)), false).eigenvalues());
    };
    const auto flutters = [&](double speed) {
        const Eigen::VectorXcd values = squares(speed);
        return values.imag().cwiseAbs().maxCoeff() > 0;
    };
    const double step = largest_speed / 1000;
    double high = step;
    while (high < largest_speed && !flutters(high)) high += step;
    if (high >= largest_speed) throw std::runtime_error("strip flutter: no frequencies meet");
    double low = high - step;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (flutters(middle) ? high : low) = middle;
    }
    const Eigen::VectorXcd values = squares(high);
    Eigen::Index which = 0;
    values.imag().cwiseAbs().maxCoeff(&which);
    return {high, std::sqrt(values(which)).real()};
}

}  // namespace cardan::oracles
