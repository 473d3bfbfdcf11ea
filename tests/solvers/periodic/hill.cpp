#include "tests/solvers/periodic/hill.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/azimuth_series.hpp"
#include "solvers/algebra/real_eigen.hpp"
#include "solvers/periodic/detail/normalised_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cardan::testing {

namespace hills_method {

using namespace solvers;
using solvers::PeriodicSystem;  // rather than other tests' own

namespace {

using Index = Eigen::Index;
constexpr const char* in_hills_method = "Hill's method";

// (A - sigma E)^-1 E projected on the harmonics 1, cos, sin, cos 2, ... of the time omega t; its eigenvalues are
// 1 / (lambda - sigma). Large ones, slow motions, keep their accuracy beside stiff ones. States in the units of
// units_of_states(). Row and column l n + i: harmonic l of state i.
Matrix inverted_pencil(const PeriodicSystem& system, int H, int samples, double sigma, const Vector& unit) {
    const Index n = system.states(), count = 2 * H + 1;
    const double omega = system.frequency();
    Matrix left = Matrix::Zero(n * count, n * count), right = left, E, A;
    for (int s = 0; s < samples; ++s) {
        const double angle = 2 * pi * s / samples;
        system.at(angle / omega, E, A);
        E = (omega * E * unit.asDiagonal()).eval();
        A = (A * unit.asDiagonal() - sigma * E).eval();
        const Vector b = fourier_basis(angle, H), d = fourier_basis(angle, H, 1),
                     w = fourier_weights(angle, H, samples);
        for (Index l = 0; l < count; ++l)
            for (Index k = 0; k < count; ++k) {
                left.block(k * n, l * n, n, n) += w(k) * (b(l) * A - d(l) * E);
                right.block(k * n, l * n, n, n) += w(k) * b(l) * E;
            }
    }
    // Rows of unit length: those of stiff coordinates would take all pivots.
    const Vector length = left.rowwise().norm().cwiseMax(std::numeric_limits<double>::min());
    left.array().colwise() /= length.array();
    right.array().colwise() /= length.array();
    return left.partialPivLu().solve(right);
}

struct Candidate {
    FloquetSolution solution;
    double centre = 0;  // of the harmonics
};

// Energy, with omega^2 beside |lambda|^2: a rigid displacement counts as well.
double size_of_harmonic(const FloquetSolution& s, const EnergyWeights& w, double omega, Index i) {
    const Index H = s.harmonics.cols() / 2;
    const ComplexVector c = s.harmonics.col(i);
    const Complex lambda = s.exponent + Complex(0, omega * static_cast<double>(i - H));
    return (c.adjoint() * (w.K * c)).value().real() +
           (std::norm(lambda) + omega * omega) * (c.adjoint() * (w.M * c)).value().real();
}

// Of the states, in units of their scales, in what is their motion.
double centre_of(const FloquetSolution& s, const EnergyWeights& w, double omega) {
    const Index H = s.harmonics.cols() / 2;
    double sum = 0, moment = 0;
    for (Index i = 0; i <= 2 * H; ++i) {
        const double e = s.state_share >= 0.5 ? s.state_harmonics.col(i).cwiseQuotient(w.scales).squaredNorm()
                                              : size_of_harmonic(s, w, omega, i);
        sum += e;
        moment += static_cast<double>(i - H) * e;
    }
    return sum > 0 ? moment / sum : 0;
}

// Two copies of one motion if both centres lie half a harmonic from zero.
bool same_motion(const Candidate& a, const Candidate& b, double omega) {
    constexpr double close = 1e-6;
    if (std::abs(std::abs(a.centre) - 0.5) > close || std::abs(std::abs(b.centre) - 0.5) > close) return false;
    if ((a.centre > 0) == (b.centre > 0)) return false;
    const Complex moved = a.solution.exponent + Complex(0, a.centre > 0 ? omega : -omega);
    return std::abs(moved - b.solution.exponent) < 1e-5 * omega;
}

// c_j from the coefficients of 1, cos, sin, cos 2, ... by column.
ComplexMatrix exponential_series(const ComplexMatrix& series) {
    const Index H = series.cols() / 2;
    ComplexMatrix c(series.rows(), series.cols());
    c.col(H) = series.col(0);
    for (Index j = 1; j <= H; ++j) {
        c.col(H + j) = (series.col(2 * j - 1) - Complex(0, 1) * series.col(2 * j)) / 2;
        c.col(H - j) = (series.col(2 * j - 1) + Complex(0, 1) * series.col(2 * j)) / 2;
    }
    return c;
}

Candidate conjugate(const Candidate& one) {
    Candidate other = one;
    other.solution.exponent = std::conj(one.solution.exponent);
    other.solution.harmonics = one.solution.harmonics.conjugate().rowwise().reverse();
    other.solution.state_harmonics = one.solution.state_harmonics.conjugate().rowwise().reverse();
    other.centre = -one.centre;
    return other;
}

// Positions of all harmonics first, then states beside them: without these no eigenvectors are wanted of more.
std::vector<Index> positions_first(const PeriodicSystem& system, int H) {
    const Index n = system.states(), r = system.rows(), rates = n - system.states_beside(), count = 2 * H + 1;
    std::vector<Index> order;
    order.reserve(static_cast<std::size_t>(n * count));
    for (const auto& [from, to] : {std::pair(Index(0), r), std::pair(rates, n), std::pair(r, rates)})
        for (Index l = 0; l < count; ++l)
            for (Index i = from; i < to; ++i) order.push_back(l * n + i);
    return order;
}

// EnergyFraction of the states beside the coordinates in every mode, as Mode::state_share, by the rows of the inverse
// of all eigenvectors, the left ones.
class StateShares {
public:
    /// @param V  real and imaginary parts of all eigenvectors by column; none: no states beside the coordinates
    /// @param first, count  rows of the states
    StateShares(const Matrix& V, Index first, Index count) : V_(V), first_(first), count_(count) {
        if (count > 0) left_ = V.partialPivLu().inverse();
    }
    double operator()(const RealEigen::Value& value) const {
        if (count_ == 0) return 0;
        const double states = part(value, first_, count_);
        const double rest = part(value, 0, first_, first_ + count_, V_.rows() - first_ - count_);
        return states / (states + rest);
    }

private:
    double part(const RealEigen::Value& value, Index first, Index count, Index second = 0, Index more = 0) const {
        const Index c = value.column;
        const auto sum = [&](Index row, Index column) {
            return left_.row(row).segment(first, count).dot(V_.col(column).segment(first, count)) +
                   left_.row(row).segment(second, more).dot(V_.col(column).segment(second, more));
        };
        if (value.mu.imag() == 0) return std::abs(sum(c, c));
        // (w_1 - i w_2) (v_1 + i v_2) / 2
        return std::abs(Complex(sum(c, c) + sum(c + 1, c + 1), sum(c, c + 1) - sum(c + 1, c))) / 2;
    }

    const Matrix& V_;
    Matrix left_;
    Index first_, count_;
};

std::vector<Candidate> candidates(const PeriodicSystem& system, const Matrix& S, double sigma, int H,
                                  const Vector& unit, const EnergyWeights& weights) {
    const Index r = system.rows(), m = system.states_beside(), count = 2 * H + 1;
    const std::vector<Index> order = positions_first(system, H);
    RealEigen eigen(S.rows(), m > 0 ? S.rows() : r * count);
    if (!eigen.compute(S(order, order)))
        throw NumericalError("Hill's method: the eigenvalue iteration did not converge");
    const Matrix vectors = eigen.vectors();
    const StateShares share(vectors, r * count, m * count);
    const double omega = system.frequency();
    double largest = 0;
    for (const RealEigen::Value& value : eigen.values()) largest = std::max(largest, std::abs(value.mu));
    std::vector<Candidate> found;
    const auto add = [&](Candidate one) {
        const bool known = std::any_of(found.begin(), found.end(),
                                       [&](const Candidate& other) { return same_motion(one, other, omega); });
        if (!known) found.push_back(std::move(one));
    };
    for (const RealEigen::Value& value : eigen.values()) {
        if (!(std::abs(value.mu) > 1e-13 * largest)) continue;  // infinite: algebraic states
        const bool pair = value.mu.imag() != 0;
        ComplexVector x = vectors.col(value.column).cast<Complex>();
        if (pair) x += Complex(0, 1) * vectors.col(value.column + 1);
        Candidate one;
        one.solution.exponent = omega * (sigma + 1.0 / value.mu);
        one.solution.error = std::numeric_limits<double>::quiet_NaN();
        one.solution.harmonics = exponential_series(unit.head(r).asDiagonal() * x.head(r * count).reshaped(r, count));
        one.solution.state_harmonics =
            exponential_series(unit.tail(m).asDiagonal() * x.segment(r * count, m * count).reshaped(m, count));
        one.solution.state_share = share(value);
        one.centre = centre_of(one.solution, weights, omega);
        if (std::abs(one.centre) > 0.5 + 1e-7) continue;
        if (pair) add(conjugate(one));
        add(std::move(one));
    }
    return found;
}

Floquet exponents(const PeriodicSystem& system, const HillOptions& options) {
    const int H = options.harmonics;
    if (H < 1 || H > 200) throw InputError(in_hills_method, "number of harmonics", H, "1 ... 200");
    const int samples = options.samples > 0 ? options.samples : std::max(64, 8 * (H + 1));
    if (options.samples < 0 || samples < 4 * H + 1)
        throw InputError(in_hills_method, "number of samples", options.samples, text(">= ", 4 * H + 1, ", or 0"));
    constexpr double sigma = 0.3137;  // no one's exponent over omega
    const EnergyWeights weights(system, samples, options.weight);
    const Vector unit = units_of_states(system, in_hills_method);
    const Matrix S = inverted_pencil(system, H, samples, sigma, unit);
    if (!S.allFinite()) throw NumericalError("Hill's method: the pencil is singular");
    const std::vector<Candidate> found = candidates(system, S, sigma, H, unit, weights);

    Floquet result;
    result.period = system.period();
    result.damped_out = static_cast<int>(system.states()) - static_cast<int>(found.size());
    if (result.damped_out < 0 || (system.is_second_order() && result.damped_out > 0))
        throw NumericalError(text("Hill's method: ", found.size(), " exponents found for ", system.states(),
                                  " states; take more than ", H, " harmonics"));
    std::vector<Complex> logarithms;
    logarithms.reserve(found.size());
    for (const Candidate& one : found) logarithms.push_back(one.solution.exponent * system.period());
    for (const Representative& which : representatives(logarithms)) {
        FloquetSolution solution = found[which.index].solution;
        solution.real_multiplier = which.real;
        if (which.real) {
            const double half = system.frequency() / 2;
            solution.exponent.imag(half * std::round(solution.exponent.imag() / half));
        }
        result.modes.push_back(make_mode(solution, weights, system.period()));
    }
    sort_modes(result.modes);
    return result;
}

}  // namespace

}  // namespace hills_method

solvers::Floquet hill(const solvers::PeriodicSystem& system, const HillOptions& options) {
    return hills_method::exponents(system, options);
}

}  // namespace cardan::testing
