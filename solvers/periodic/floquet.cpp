#include "solvers/periodic/floquet.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/fft.hpp"
#include "solvers/algebra/product_eigen.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;
constexpr const char* in_floquet_theory = "Floquet theory";

// The system in coordinates of unit inertia at t = 0 and in the time omega t: states alike in size.
struct Normalised {
    explicit Normalised(const PeriodicSystem& raw);
    PeriodicSystem system;
    Vector unit;  ///< states of `raw` over those of `system`
};

Vector units(const PeriodicSystem& raw) {
    Vector unit = Vector::Ones(raw.states());
    if (!raw.is_second_order()) return unit;
    SecondOrderSystem at;
    raw.at(0, at);
    for (Index i = 0; i < raw.rows(); ++i) {
        if (!(at.M(i, i) > 0))
            throw InputError(in_floquet_theory, text("inertia of row ", i), at.M(i, i),
                             "> 0 in a system of second order");
        unit(i) = 1 / std::sqrt(at.M(i, i));
    }
    unit.tail(raw.rows()) = raw.frequency() * unit.head(raw.rows());
    return unit;
}

PeriodicSystem normalised(const PeriodicSystem& raw, const Vector& unit) {
    const double omega = raw.frequency();
    if (!raw.is_second_order())
        return PeriodicSystem::first_order(2 * pi, raw.rows(), [raw, omega](double angle, Matrix& E, Matrix& A) {
            raw.at(angle / omega, E, A);
            E *= omega;
        });
    const Vector d = unit.head(raw.rows());
    return PeriodicSystem::second_order(2 * pi, raw.rows(), [raw, omega, d](double angle, SecondOrderSystem& out) {
        raw.at(angle / omega, out);
        const auto scale = d.asDiagonal();
        out.M = (scale * out.M * scale).eval();
        out.C = (scale * out.C * scale / omega).eval();
        out.K = (scale * out.K * scale / (omega * omega)).eval();
    });
}

Normalised::Normalised(const PeriodicSystem& raw) : system(normalised(raw, units(raw))), unit(units(raw)) {}

// Grid of a Q-th of the period: samples, of which each factor of the product takes as many, and steps in each.
struct Grid {
    int samples, factors, steps;
};

int smallest_divisor(int number, int least) {
    for (int d = std::max(least, 1); d < number; ++d)
        if (number % d == 0) return d;
    return number;
}

Grid make_grid(const FloquetOptions& options) {
    const int Q = options.symmetry.parts;
    const int wanted = static_cast<int>(std::ceil((4 * options.per_period + 8) / Q));
    if (options.steps == 0) {
        const int factors = std::min(options.factors, wanted);
        return {(wanted + factors - 1) / factors * factors, factors, 1};
    }
    const int steps = options.steps / Q, samples = smallest_divisor(steps, wanted);
    int factors = std::min(options.factors, samples);
    while (samples % factors != 0) --factors;
    return {samples, factors, steps / samples};
}

void check(const PeriodicSystem& system, const FloquetOptions& options) {
    const BladeSymmetry& symmetry = options.symmetry;
    if (symmetry.parts < 1) throw InputError(in_floquet_theory, "number of identical parts", symmetry.parts, ">= 1");
    if (options.steps < 0 || options.steps % symmetry.parts != 0)
        throw InputError(in_floquet_theory, "steps per period", options.steps,
                         text(">= 0 and a multiple of the number of identical parts, ", symmetry.parts));
    if (options.factors < 1 || options.factors > 64)
        throw InputError(in_floquet_theory, "number of factors", options.factors, "1 ... 64");
    require_positive(in_floquet_theory, "tolerance", options.tolerance);
    if (!(options.per_period >= 0) || options.per_period > 1e4)
        throw InputError(in_floquet_theory, "frequency per period up to which modes are wanted", options.per_period,
                         "0 ... 1e4");
    if (options.max_steps < 1) throw InputError(in_floquet_theory, "limit of steps", options.max_steps, ">= 1");
    const double difference = asymmetry(system, symmetry);
    if (!(difference < 1e-7))
        throw InputError(in_floquet_theory, text("difference of the ", symmetry.parts, " parts"), difference,
                         "below 1e-7; parts that differ need the whole period");
}

// Coefficients of exp(i j t) from equidistant samples, j = -J ... J by column, of every row.
ComplexMatrix fourier_transform(const ComplexMatrix& samples) {
    const auto S = static_cast<std::size_t>(samples.cols());
    const Index J = (samples.cols() - 1) / 2;
    RealFourier fourier(S);
    Vector row(samples.cols());
    ComplexVector X(static_cast<Index>(fourier.frequencies())), Y(X.size());
    const auto transform = [&](ComplexVector& out) {
        fourier.transform({row.data(), S}, {out.data(), fourier.frequencies()});
    };
    ComplexMatrix harmonics(samples.rows(), 2 * J + 1);
    for (Index i = 0; i < samples.rows(); ++i) {
        row = samples.row(i).real();
        transform(X);
        row = samples.row(i).imag();
        transform(Y);
        for (Index j = 0; j <= J; ++j) {
            harmonics(i, J + j) = X(j) + Complex(0, 1) * Y(j);
            harmonics(i, J - j) = std::conj(X(j)) + Complex(0, 1) * std::conj(Y(j));
        }
    }
    return harmonics / static_cast<double>(S);
}

class Analysis {
public:
    Analysis(const PeriodicSystem& system, const FloquetOptions& options)
        : raw_(system), options_(options), normalised_(system), grid_(make_grid(options)) {
        const int Q = options.symmetry.parts;
        angle_ = 2 * pi / Q;
        if (Q > 1) set_permutation();
    }
    Floquet compute();

private:
    void set_permutation();
    std::vector<Matrix> integrate(int steps) const;
    std::vector<Matrix> factors(const std::vector<Matrix>& samples) const;
    void analyse(const ProductEigen& eigen, Floquet& result) const;
    FloquetSolution solution(const ProductEigen& eigen, const Representative& which) const;
    double error(const ProductEigen::Vectors& v) const;
    ComplexMatrix periodic_vector(const ProductEigen::Vectors& v, Complex exponent) const;
    void transform(const ComplexMatrix& samples, FloquetSolution& out) const;
    bool wanted(const FloquetMode& mode) const;
    bool accurate(const FloquetMode& mode) const;
    bool improvable(const FloquetMode& mode) const;
    /// Rounding error of an exponent over the frequency.
    double rounding(double condition) const { return 1e-15 * condition / angle_; }

    const PeriodicSystem& raw_;
    const FloquetOptions& options_;
    Normalised normalised_;
    Grid grid_;
    double angle_;                          // omega T / Q
    Matrix permutation_, raw_permutation_;  // of the normalised and of the raw states
    std::vector<Matrix> fine_;              // transitions between samples
    std::vector<Matrix> difference_;        // of the factors, coarse - fine
};

void Analysis::set_permutation() {
    const Index n = raw_.rows(), states = raw_.states();
    raw_permutation_.setZero(states, states);
    for (Index at = 0; at < states; at += n) raw_permutation_.block(at, at, n, n) = options_.symmetry.P;
    permutation_ = normalised_.unit.cwiseInverse().asDiagonal() * raw_permutation_ * normalised_.unit.asDiagonal();
}

std::vector<Matrix> Analysis::integrate(int steps) const {
    return transitions(normalised_.system, 0, angle_, grid_.samples, steps, options_.transition);
}

// P Phi(T/Q) as a product.
std::vector<Matrix> Analysis::factors(const std::vector<Matrix>& samples) const {
    const std::size_t each = samples.size() / static_cast<std::size_t>(grid_.factors);
    std::vector<Matrix> product;
    for (std::size_t k = 0; k < samples.size(); k += each) {
        Matrix F = samples[k];
        for (std::size_t i = k + 1; i < k + each; ++i) F = samples[i] * F;
        product.push_back(std::move(F));
    }
    if (permutation_.size() > 0) product.back() = permutation_ * product.back();
    return product;
}

// Largest first-order change of log mu from the coarse integration to the fine one, over what the order makes of it; a
// factor of two per order of the method is taken off for steps that are not short yet.
double Analysis::error(const ProductEigen::Vectors& v) const {
    if (difference_.empty()) return std::numeric_limits<double>::quiet_NaN();
    Complex change = 0;
    const Index p = v.growth.size();
    for (Index k = 0; k < p; ++k)
        change +=
            (v.left.col((k + 1) % p).transpose() * (entry(difference_, k) * v.right.col(k))).value() / v.growth(k);
    const int stages = options_.transition.method == TransitionMethod::radau ? options_.transition.stages : 1;
    return std::abs(change) / angle_ / std::pow(2.0, stages) + rounding(v.condition);
}

// p at the samples over the whole period, in raw states. From one factor to the next the vectors are known; between,
// they are integrated.
ComplexMatrix Analysis::periodic_vector(const ProductEigen::Vectors& v, Complex exponent) const {
    const int Q = options_.symmetry.parts, S = grid_.samples, each = S / grid_.factors;
    ComplexMatrix p(raw_.states(), Q * S);
    Complex grown = 0;  // logarithm
    ComplexVector x;
    for (int s = 0; s < S; ++s) {
        if (s % each == 0) x = v.right.col(s / each);
        const Complex factor = std::exp(grown - exponent * (angle_ * s / S));
        p.col(s) = factor * normalised_.unit.cwiseProduct(x);
        x = entry(fine_, s) * x;
        if ((s + 1) % each == 0) grown += std::log(v.growth(s / each));
    }
    for (int s = S; s < Q * S; ++s) p.col(s) = raw_permutation_.transpose() * p.col(s - S);
    return p;
}

// Harmonics of the positions; rates that are not their derivatives belong to motions too fast for the samples.
void Analysis::transform(const ComplexMatrix& samples, FloquetSolution& out) const {
    const Index J = (samples.cols() - 1) / 2, n = raw_.rows();
    const ComplexMatrix harmonics = fourier_transform(samples);
    out.harmonics = harmonics.topRows(n);
    out.resolved = true;
    if (!raw_.is_second_order()) return;
    double off = 0, all = 0;
    for (Index j = -J; j <= J; ++j) {
        const Complex lambda = out.exponent + Complex(0, raw_.frequency() * static_cast<double>(j));
        const ComplexVector rate = harmonics.col(j + J).tail(n).cwiseQuotient(normalised_.unit.head(n));
        const ComplexVector own = lambda * harmonics.col(j + J).head(n).cwiseQuotient(normalised_.unit.head(n));
        off += (rate - own).squaredNorm();
        all += std::max(rate.squaredNorm(), own.squaredNorm());
    }
    // A rigid displacement has rates of the size of rounding.
    const double at_rest = 1e-12 * raw_.frequency() * raw_.frequency() *
                           out.harmonics.cwiseQuotient(normalised_.unit.head(n).replicate(1, 2 * J + 1)).squaredNorm();
    // With an alias they are off by the rate of the samples, two fifths of the energy at least.
    out.resolved = off <= 0.2 * all + at_rest;
}

FloquetSolution Analysis::solution(const ProductEigen& eigen, const Representative& which) const {
    const auto i = static_cast<Index>(which.index);
    const ProductEigen::Vectors v = eigen.vectors(i);
    Complex logarithm = eigen.logarithm(i);
    if (which.real) logarithm.imag(std::abs(logarithm.imag()) < pi / 2 ? 0 : pi);
    const Complex scaled = logarithm / angle_;
    FloquetSolution out;
    out.exponent = raw_.frequency() * scaled;
    out.real_multiplier = which.real;
    out.condition = v.condition;
    out.error = raw_.frequency() * error(v);
    transform(periodic_vector(v, scaled), out);
    return out;
}

bool Analysis::wanted(const FloquetMode& mode) const {
    return mode.kind != FloquetKind::rigid && mode.per_period() <= options_.per_period;
}

bool Analysis::accurate(const FloquetMode& mode) const {
    return !wanted(mode) || mode.error <= options_.tolerance * raw_.frequency();
}

// Whether shorter steps would make a mode accurate that is not.
bool Analysis::improvable(const FloquetMode& mode) const {
    return !accurate(mode) && !(mode.error <= 2 * raw_.frequency() * rounding(mode.condition));
}

void Analysis::analyse(const ProductEigen& eigen, Floquet& result) const {
    // Below this the factors hold nothing but rounding: log(1e-14).
    constexpr double lowest_level = -32;
    const EnergyWeights weights(raw_, grid_.samples * options_.symmetry.parts, options_.weight);
    std::vector<Complex> logarithms;
    std::vector<std::size_t> at;
    for (Index i = 0; i < eigen.size(); ++i) {
        if (!(eigen.mean_level(i) > lowest_level)) continue;
        logarithms.push_back(eigen.logarithm(i));
        at.push_back(static_cast<std::size_t>(i));
    }
    result.modes.clear();
    result.unresolved.clear();
    result.damped_out = static_cast<int>(eigen.size()) - static_cast<int>(at.size());
    for (Representative which : representatives(logarithms)) {
        which.index = at[which.index];
        const FloquetSolution one = solution(eigen, which);
        (one.resolved ? result.modes : result.unresolved).push_back(make_mode(one, weights, raw_.period()));
    }
    sort_modes(result.modes);
    sort_modes(result.unresolved);
}

Floquet Analysis::compute() {
    const int parts = options_.symmetry.parts;
    Floquet result;
    result.period = raw_.period();
    int steps = grid_.steps;
    fine_ = integrate(steps);
    std::vector<Matrix> product = factors(fine_);
    const bool refine = options_.steps == 0;
    while (true) {
        if (refine) {
            difference_ = std::move(product);
            steps *= 2;
            fine_ = integrate(steps);
            product = factors(fine_);
            for (std::size_t k = 0; k < product.size(); ++k) difference_[k] -= product[k];
        }
        ProductEigen eigen;
        if (!eigen.compute(product))
            throw NumericalError("Floquet theory: the eigenvalue iteration on the monodromy matrix did not converge");
        analyse(eigen, result);
        result.steps = steps * grid_.samples * parts;
        const bool enough = std::none_of(result.modes.begin(), result.modes.end(),
                                         [&](const FloquetMode& mode) { return improvable(mode); });
        if (!refine || enough || 2 * result.steps > options_.max_steps) break;
    }
    const auto rough = std::count_if(result.modes.begin(), result.modes.end(),
                                     [&](const FloquetMode& mode) { return !accurate(mode); });
    if (refine && rough > 0)
        result.note = text(rough, " mode(s) are less accurate than wanted with ", result.steps,
                           " steps per period; see their errors and conditions, or allow more steps");
    return result;
}

}  // namespace

double Floquet::growth() const {
    double largest = -std::numeric_limits<double>::infinity();
    for (const FloquetMode& mode : modes)
        if (mode.kind != FloquetKind::rigid) largest = std::max(largest, mode.growth());
    return largest;
}

Floquet floquet(const PeriodicSystem& system, const FloquetOptions& options) {
    check(system, options);
    return Analysis(system, options).compute();
}

}  // namespace cardan::solvers
