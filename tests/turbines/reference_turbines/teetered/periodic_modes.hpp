/// @file
/// Floquet's theory for the tests: Radau IIA over one sector of the revolution, exponents with the harmonic that holds
/// most of the elastic energy. Independent of the library's solvers but for the linearisation.
#pragma once

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/linear/linearise.hpp"

#include <algorithm>
#include <functional>
#include <string>

namespace cardan::testing {

/// Radau IIA of order 5 for M q'' + C q' + K q = 0, matrices given at the stages: L-stable, so the stiff modes of the
/// chain die out. State (q, q'), one column per initial value.      [Hairer and Wanner, Solving ODEs II, table IV.5.6]
struct Radau {
    Mat3 A;
    Vec3 c;
    Radau() {
        const double r = std::sqrt(6.0);
        A << (88 - 7 * r) / 360, (296 - 169 * r) / 1800, (-2 + 3 * r) / 225,  //
            (296 + 169 * r) / 1800, (88 + 7 * r) / 360, (-2 - 3 * r) / 225,   //
            (16 - r) / 36, (16 + r) / 36, 1. / 9;
        c << (4 - r) / 10, (4 + r) / 10, 1;
    }
    /// @param at  at(i): the system at stage i
    template <class Stage>
    void step(double h, const Stage& at, Matrix& x) const {
        const Eigen::Index n = x.rows() / 2;
        const Mat3 AA = A * A;
        const auto q = x.topRows(n), v = x.bottomRows(n);
        Matrix left(3 * n, 3 * n), right(3 * n, x.cols());
        for (Eigen::Index i = 0; i < 3; ++i) {
            const solvers::SecondOrderSystem s = at(i);
            for (Eigen::Index j = 0; j < 3; ++j)
                left.block(i * n, j * n, n, n) =
                    (i == j ? s.M : Matrix::Zero(n, n)) + h * A(i, j) * s.C + h * h * AA(i, j) * s.K;
            right.middleRows(i * n, n) = -s.C * v - s.K * (q + c(i) * h * v);
        }
        const Matrix a = left.partialPivLu().solve(right);  // accelerations at the stages
        const Matrix q_end =
            q + h * v + h * h * (AA(2, 0) * a.topRows(n) + AA(2, 1) * a.middleRows(n, n) + AA(2, 2) * a.bottomRows(n));
        x.bottomRows(n) += h * (A(2, 0) * a.topRows(n) + A(2, 1) * a.middleRows(n, n) + A(2, 2) * a.bottomRows(n));
        x.topRows(n) = q_end;
    }
};

/// The system over its unknowns at an azimuth; dots are per unit of azimuth times the rotor speed (that is, per
/// second).
using PeriodicSystem = std::function<solvers::SecondOrderSystem(double azimuth)>;

/// Coordinates of a two-bladed machine in which half a revolution is a change of sign: z = T q with sums and
/// differences of the blades over sqrt(2); rows of z by family.
struct HalfTurnCoordinates {
    Matrix T;                         ///< orthonormal
    std::vector<bool> odd;            ///< per row: changes sign over half a revolution (differences, teeter)
    std::vector<std::string> family;  ///< per row
};

/// One exponent with its principal frequency.
struct PeriodicMode {
    Complex exponent;  ///< per rev: exp(exponent psi); imaginary part the principal frequency
    std::string family;
    double share;        ///< of the elastic energy in that harmonic and family
    double in_harmonic;  ///< of the elastic energy in that harmonic, all families
};

/// Decay that Radau IIA of order 5 gives an undamped mode of f per rev, per rev: |R(i z)| = 1 - z^6/7200 + O(z^8).
inline double radau_decay(double f, int steps_per_half_turn) {
    return f * std::pow(f * pi / steps_per_half_turn, 5) / 7200;
}

struct HalfTurnFloquet {
    Eigen::VectorXcd multipliers;  ///< of half a revolution with the exchange of the blades; all of them
    /// Oscillating modes that have not died out, principal frequency positive, rising. Modes without elastic energy
    /// (free yaw, teeter) are among the multipliers only.
    std::vector<PeriodicMode> modes;

    /// Exponents of a family, rising in frequency.
    std::vector<Complex> of(const std::string& family) const {
        std::vector<Complex> found;
        for (const PeriodicMode& mode : modes)
            if (mode.family == family) found.push_back(mode.exponent);
        return found;
    }
};

namespace detail {

/// Principal harmonic of z(psi) = sum_k c_k exp((sigma + i k) psi) from samples over half a revolution. The search is
/// centred on the energy-weighted mean frequency, found from positions and rates.
/// @param z, rate  one column per sample; rate: dz/dpsi
inline PeriodicMode principal(const ComplexMatrix& z, const ComplexMatrix& rate, Complex sigma, const Matrix& K,
                              const HalfTurnCoordinates& by) {
    const Eigen::Index samples = z.cols(), n = z.rows();
    double energy = 0, moment = 0;
    ComplexMatrix p(n, samples);
    for (Eigen::Index i = 0; i < samples; ++i) {
        const Complex decay = std::exp(-sigma * (pi * static_cast<double>(i) / static_cast<double>(samples)));
        p.col(i) = z.col(i) * decay;
        const ComplexVector force = K * p.col(i);
        energy += force.dot(p.col(i)).real();
        moment += force.dot(ComplexVector(rate.col(i) * decay)).imag();
    }
    energy /= static_cast<double>(samples);
    const int centre = static_cast<int>(std::lround(moment / static_cast<double>(samples) / energy - sigma.imag()));
    PeriodicMode best{sigma, "", -1, 0};
    for (int k = centre - 40; k <= centre + 40; ++k) {
        ComplexVector c = ComplexVector::Zero(n);
        for (Eigen::Index i = 0; i < samples; ++i)
            c += p.col(i) * std::exp(Complex(0, -k * pi * static_cast<double>(i) / static_cast<double>(samples)));
        for (Eigen::Index row = 0; row < n; ++row)
            c(row) *= entry(by.odd, row) == (k % 2 != 0) ? 1 / static_cast<double>(samples) : 0;
        std::vector<std::pair<std::string, double>> families;
        const ComplexVector force = K * c;
        double all = 0;
        for (Eigen::Index row = 0; row < n; ++row) {
            const std::string& name = entry(by.family, row);
            auto at = std::find_if(families.begin(), families.end(), [&](const auto& f) { return f.first == name; });
            if (at == families.end()) at = families.insert(at, {name, 0.0});
            const double e = (std::conj(c(row)) * force(row)).real() / energy;
            at->second += e;
            all += e;
        }
        for (const auto& [name, e] : families)
            if (e > best.share) best = {sigma + Complex(0, k), name, e, all};
    }
    return best;
}

}  // namespace detail

/// Floquet's theory over half a revolution of a two-bladed machine.
/// @param steps    of Radau IIA over half a revolution, a multiple of `samples`; a mode of f per rev wants about 4 f
/// @param weakest  multipliers below this size belong to modes that the method has damped out
inline HalfTurnFloquet half_turn_floquet(const PeriodicSystem& at, double rotor_speed, const HalfTurnCoordinates& by,
                                         int steps, double weakest = 0.5, int samples = 100) {
    const Eigen::Index n = by.T.rows();
    const Radau radau;
    const double h = pi / rotor_speed / steps;
    if (steps % samples != 0) throw Error("the number of samples must divide the number of steps");
    Matrix x = Matrix::Identity(2 * n, 2 * n);
    std::vector<Matrix> sampled;
    for (int i = 0; i < steps; ++i) {
        if (i % (steps / samples) == 0) sampled.push_back(x);
        radau.step(
            h, [&](Eigen::Index s) { return at(rotor_speed * (i + radau.c(s)) * h); }, x);
    }
    // In sums and differences, blades exchanged.
    Matrix T = Matrix::Zero(2 * n, 2 * n);
    T.topLeftCorner(n, n) = T.bottomRightCorner(n, n) = by.T;
    Matrix shifted = T * x * T.transpose();
    for (Eigen::Index row = 0; row < n; ++row)
        if (entry(by.odd, row)) shifted.row(row) *= -1, shifted.row(n + row) *= -1;
    const Eigen::EigenSolver<Matrix> solver(shifted);

    HalfTurnFloquet result;
    result.multipliers = solver.eigenvalues();
    const Matrix K = by.T * at(0).K_elastic * by.T.transpose();
    const ComplexMatrix shapes = T.transpose() * solver.eigenvectors();
    for (Eigen::Index m = 0; m < 2 * n; ++m) {
        const Complex mu = result.multipliers(m);
        const bool rigid = std::abs(mu - 1.0) < 1e-3 || (mu.imag() == 0 && std::abs(std::abs(mu) - 1) > 1e-3);
        if (rigid || std::abs(mu) < weakest) continue;
        ComplexMatrix z(n, samples), rate(n, samples);
        for (Eigen::Index i = 0; i < samples; ++i) {
            const ComplexVector state = entry(sampled, i) * shapes.col(m);
            z.col(i) = by.T * state.head(n);
            rate.col(i) = by.T * state.tail(n) / rotor_speed;
        }
        const PeriodicMode mode = detail::principal(z, rate, std::log(mu) / pi, K, by);
        if (mode.exponent.imag() > 0) result.modes.push_back(mode);
    }
    std::sort(result.modes.begin(), result.modes.end(),
              [](const PeriodicMode& a, const PeriodicMode& b) { return a.exponent.imag() < b.exponent.imag(); });
    return result;
}

}  // namespace cardan::testing
