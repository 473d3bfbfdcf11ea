#include "solvers/periodic/floquet.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/azimuth_series.hpp"
#include "solvers/algebra/dense.hpp"
#include "solvers/algebra/product_eigen.hpp"
#include "solvers/periodic/detail/floquet_grid.hpp"
#include "solvers/periodic/detail/motion_vectors.hpp"
#include "solvers/periodic/detail/normalised_system.hpp"
#include "solvers/periodic/detail/slow_motions.hpp"
#include "solvers/periodic/detail/varying_part.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;
constexpr const char* in_floquet_theory = "Floquet theory";

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

class Analysis {
public:
    Analysis(const PeriodicSystem& system, const FloquetOptions& options)
        : raw_(system), options_(options), normalised_(system, in_floquet_theory), grid_(floquet_grid(options)) {
        const int Q = options.symmetry.parts;
        angle_ = 2 * pi / Q;
        if (Q > 1) set_permutation();
        find_varying_part();
        if (options.only_slow && raw_.is_second_order()) leave_out_fast();
        // Their harmonics are those of what has been found, too.
        const int samples = slow_ ? slow_->azimuths() : varying_ ? VaryingPart::azimuths : grid_.samples * Q;
        weights_.emplace(raw_, samples, options.weight);
    }
    Floquet compute();

private:
    void set_permutation();
    void find_varying_part();
    void leave_out_fast();
    void find_slow_motions();
    /// From sample to sample.
    std::vector<Matrix> transitions_between(int samples, int steps);
    /// What is integrated: all motions or the slow ones.
    const PeriodicSystem& integrated() const { return slow_ ? slow_->system() : normalised_.system; }
    std::vector<Matrix> factors(const std::vector<Matrix>& samples) const;
    void analyse(const ProductEigen& eigen, Floquet& result) const;
    struct Motion {
        Representative which;
        ProductEigen::Vectors vectors;
        Complex exponent;  // of the normalised system
        ComplexMatrix p;   // at the samples over the whole period, in raw states
    };
    Motion motion(const ProductEigen& eigen, const Representative& which) const;
    bool fast(const Motion& motion) const;
    void integrate(std::span<Motion> motions) const;
    FloquetSolution solution(const Motion& motion) const;
    double change(const ProductEigen::Vectors& v) const;
    double error(const FloquetMode& mode, double change) const;
    double step() const { return angle_ / grid_.samples / grid_.steps; }
    void transform(const ComplexMatrix& samples, FloquetSolution& out) const;
    bool wanted(const FloquetMode& mode) const;
    bool accurate(const FloquetMode& mode) const;
    double worst(const std::vector<FloquetMode>& modes) const;
    /// Rounding error of an exponent over the frequency.
    double rounding(double condition) const { return 1e-15 * condition / angle_; }

    // Those that are not far above are needed where motions are followed from one system to the next.
    static constexpr double followed = 1.5;
    const PeriodicSystem& raw_;
    const FloquetOptions& options_;
    NormalisedSystem normalised_;
    FloquetGrid grid_;
    double angle_;                          // omega T / Q
    double ratio_ = 2;                      // of the longer steps to these
    Matrix permutation_, raw_permutation_;  // of the integrated and of the raw states
    std::optional<VaryingPart> varying_;
    std::optional<VaryingPartStep> varying_step_;
    std::optional<SlowMotions> slow_;
    std::optional<EnergyWeights> weights_;
    std::vector<Matrix> inertia_;     // at the factors, to tell fast motions; empty: all are wanted
    std::vector<Matrix> expansions_;  // at the samples, of the slow motions
    std::vector<Matrix> fine_;        // transitions between samples
    std::vector<Matrix> difference_;  // of the factors, coarse - fine
};

void Analysis::set_permutation() {
    raw_permutation_ = options_.symmetry.of_states(raw_);
    permutation_ = normalised_.unit.cwiseInverse().asDiagonal() * raw_permutation_ * normalised_.unit.asDiagonal();
}

void Analysis::find_varying_part() {
    constexpr double negligible = 0.01;  // part of the tolerance
    if (options_.transition.method != TransitionMethod::radau) return;
    varying_ =
        VaryingPart::find(normalised_.system, std::max(1.0, options_.per_period), negligible * options_.tolerance);
    if (varying_) varying_step_.emplace(*varying_, options_.transition.stages);
}

std::vector<Matrix> Analysis::transitions_between(int samples, int steps) {
    if (varying_step_ && !slow_) return transitions(*varying_step_, integrated().states(), 0, angle_, samples, steps);
    return transitions(integrated(), 0, angle_, samples, steps, options_.transition);
}

void Analysis::leave_out_fast() {
    // With so many samples the search is worth while although a step of a varying part costs little.
    constexpr int many = 500;
    if (!varying_ || grid_.samples > many) find_slow_motions();
    SecondOrderSystem at;
    for (int k = 0; k < grid_.factors && !slow_; ++k) {
        normalised_.system.at(angle_ * k / grid_.factors, at);
        inertia_.push_back(at.M);
    }
}

void Analysis::find_slow_motions() {
    BladeSymmetry symmetry;
    if (options_.symmetry.parts > 1)
        symmetry = {options_.symmetry.parts, permutation_.topLeftCorner(raw_.rows(), raw_.rows())};
    slow_ = SlowMotions::find(normalised_.system, symmetry, followed * options_.per_period, options_.tolerance);
    if (!slow_) return;
    if (symmetry.parts > 1) permutation_ = slow_->symmetry().of_states(slow_->system());
    for (int s = 0; s < grid_.samples; ++s) expansions_.push_back(slow_->expansion(angle_ * s / grid_.samples));
}

// P Phi(T/Q) as a product.
std::vector<Matrix> Analysis::factors(const std::vector<Matrix>& samples) const {
    const std::size_t each = samples.size() / static_cast<std::size_t>(grid_.factors);
    std::vector<Matrix> product;
    for (std::size_t k = 0; k < samples.size(); k += each) {
        Matrix F = samples[k];
        for (std::size_t i = k + 1; i < k + each; ++i) {
            Matrix next = Matrix::Zero(F.rows(), F.cols());
            add_product(next, samples[i], F);
            F.swap(next);
        }
        product.push_back(std::move(F));
    }
    if (permutation_.size() > 0) product.back() = permutation_ * product.back();
    return product;
}

// First-order change of the exponent from the longer steps to these.
double Analysis::change(const ProductEigen::Vectors& v) const {
    if (difference_.empty()) return std::numeric_limits<double>::quiet_NaN();
    Complex sum = 0;
    const Index p = v.growth.size();
    for (Index k = 0; k < p; ++k)
        sum += (v.left.col((k + 1) % p).transpose() * (entry(difference_, k) * v.right.col(k))).value() / v.growth(k);
    return std::abs(sum) / angle_;
}

// What is left of that change. Harmonics of the motion are motions of frequency |lambda_j| for the method, whose error
// for each is known, long steps included; if this is not what changed, the ratio of the steps to the power of the
// stages is what is certain.
double Analysis::error(const FloquetMode& mode, double change) const {
    const bool radau = options_.transition.method == TransitionMethod::radau;
    const int stages = radau ? options_.transition.stages : 1;
    double gain = std::pow(ratio_, stages);
    if (radau && raw_.is_second_order()) {
        double coarse = 0, fine = 0;
        for (Index i = 0; i < mode.participation.size(); ++i) {
            const double j = mode.first_harmonic + static_cast<double>(i);
            const double z = std::abs(mode.exponent / raw_.frequency() + Complex(0, j)) * step();
            coarse += mode.participation(i) * radau_step_error(ratio_ * z, stages) / (ratio_ * step());
            fine += mode.participation(i) * radau_step_error(z, stages) / step();
        }
        constexpr double doubt = 4, alike = 10;  // the model's error, that of what it says has changed
        if (change < alike * coarse) gain = std::max(gain, coarse / fine / doubt);
    }
    const double of_equations = (slow_      ? slow_->error()
                                 : varying_ ? varying_->error()
                                            : 0) /
                                2 * std::max(1.0, std::abs(mode.exponent) / raw_.frequency());
    return raw_.frequency() * (change / gain + rounding(mode.condition) + of_equations);
}

Analysis::Motion Analysis::motion(const ProductEigen& eigen, const Representative& which) const {
    const auto i = static_cast<Index>(which.index);
    Complex logarithm = eigen.logarithm(i);
    if (which.real) logarithm.imag(std::abs(logarithm.imag()) < pi / 2 ? 0 : pi);
    return {which, eigen.vectors(i), logarithm / angle_, {}};
}

// Its principal harmonic is fast, if that has a fifteenth of the energy. What grows is wanted, however fast.
bool Analysis::fast(const Motion& motion) const {
    constexpr double min_share = 1.0 / 15;
    const double limit = followed * options_.per_period;
    if (inertia_.empty() || motion.exponent.real() > options_.tolerance * limit) return false;
    return min_share * mean_square_frequency(inertia_, motion.vectors) > limit * limit;
}

// Sets p of motions, all at once. From one factor to the next their vectors are known; between, they are integrated.
void Analysis::integrate(std::span<Motion> motions) const {
    const int Q = options_.symmetry.parts, S = grid_.samples, each = S / grid_.factors;
    const Index count = std::ssize(motions), n = integrated().states();
    Matrix x(n, 2 * count), next(n, 2 * count);  // real and imaginary parts side by side
    Matrix all(raw_.states(), 2 * count);        // likewise, of all states
    std::vector<Complex> grown(motions.size());  // logarithms
    for (Motion& m : motions) m.p.resize(raw_.states(), Index{Q} * S);
    for (int s = 0; s < S; ++s) {
        for (Index k = 0; s % each == 0 && k < count; ++k) {
            const Motion& m = entry(motions, k);
            x.col(2 * k) = m.vectors.right.col(s / each).real();
            x.col(2 * k + 1) = m.vectors.right.col(s / each).imag();
        }
        if (slow_) {
            all.setZero();
            add_product(all, entry(expansions_, s), x);
        }
        const Matrix& states = slow_ ? all : x;
        for (Index k = 0; k < count; ++k) {
            Motion& m = entry(motions, k);
            const Complex factor = std::exp(entry(grown, k) - m.exponent * (angle_ * s / S));
            m.p.col(s).real() = factor.real() * states.col(2 * k) - factor.imag() * states.col(2 * k + 1);
            m.p.col(s).imag() = factor.real() * states.col(2 * k + 1) + factor.imag() * states.col(2 * k);
            m.p.col(s).array() *= normalised_.unit.array();
            if ((s + 1) % each == 0) entry(grown, k) += std::log(m.vectors.growth(s / each));
        }
        next.setZero();
        add_product(next, entry(fine_, s), x);
        x.swap(next);
    }
    for (Motion& m : motions)
        for (int s = S; s < Q * S; ++s) m.p.col(s) = raw_permutation_.transpose() * m.p.col(s - S);
}

// Harmonics of the positions; rates that are not their derivatives belong to motions too fast for the samples.
void Analysis::transform(const ComplexMatrix& samples, FloquetSolution& out) const {
    const Index J = (samples.cols() - 1) / 2, n = raw_.rows();
    const ComplexMatrix harmonics = fourier_coefficients(samples);
    out.harmonics = harmonics.topRows(n);
    out.resolved = true;
    if (!raw_.is_second_order()) return;
    out.state_harmonics = harmonics.bottomRows(raw_.states_beside());
    double off = 0, all = 0;
    for (Index j = -J; j <= J; ++j) {
        const Complex lambda = out.exponent + Complex(0, raw_.frequency() * static_cast<double>(j));
        const ComplexVector rate = harmonics.col(j + J).segment(n, n).cwiseQuotient(normalised_.unit.head(n));
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

FloquetSolution Analysis::solution(const Motion& motion) const {
    FloquetSolution out;
    out.exponent = raw_.frequency() * motion.exponent;
    out.real_multiplier = motion.which.real;
    out.condition = motion.vectors.condition;
    out.error = change(motion.vectors);
    out.state_share = state_share(raw_, motion.vectors);
    transform(motion.p, out);
    return out;
}

bool Analysis::wanted(const FloquetMode& mode) const {
    // A heavily damped one may be fast and oscillate slowly.
    const double speed = options_.only_slow ? std::abs(mode.exponent) / raw_.frequency() : mode.per_period();
    return mode.kind != FloquetKind::rigid && speed <= options_.per_period;
}

bool Analysis::accurate(const FloquetMode& mode) const {
    const double rate = std::max(raw_.frequency(), std::abs(mode.exponent));
    return !wanted(mode) || mode.error <= options_.tolerance * rate;
}

// Largest error of modes that are not accurate, and not for rounding; 0 without any.
double Analysis::worst(const std::vector<FloquetMode>& modes) const {
    double largest = 0;
    for (const FloquetMode& mode : modes)
        if (!accurate(mode) && !(mode.error <= 2 * raw_.frequency() * rounding(mode.condition)))
            largest = std::max(largest, std::isnan(mode.error) ? std::numeric_limits<double>::infinity() : mode.error);
    return largest;
}

void Analysis::analyse(const ProductEigen& eigen, Floquet& result) const {
    // Below this the factors hold nothing but rounding: log(1e-14).
    constexpr double lowest_level = -32;
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
    constexpr std::size_t at_once = 16;
    const std::vector<Representative> all = representatives(logarithms);
    std::vector<Motion> motions;
    for (std::size_t i = 0; i < all.size(); ++i) {
        motions.push_back(motion(eigen, {at[all[i].index], all[i].real}));
        if (fast(motions.back())) motions.pop_back();
        if (motions.size() < at_once && i + 1 < all.size()) continue;
        integrate(motions);
        for (const Motion& m : motions) {
            const FloquetSolution one = solution(m);
            FloquetMode& mode = (one.resolved ? result.modes : result.unresolved)
                                    .emplace_back(make_mode(one, *weights_, raw_.period()));
            mode.error = error(mode, one.error);
        }
        motions.clear();
    }
    sort_modes(result.modes);
    sort_modes(result.unresolved);
}

Floquet Analysis::compute() {
    const int parts = options_.symmetry.parts;
    Floquet result;
    result.period = raw_.period();
    const bool refine = grid_.steps == 0;
    double before = std::numeric_limits<double>::infinity();  // worst() with half the steps
    std::vector<Matrix> product;
    if (refine) product = factors(transitions_between(grid_.samples / FloquetGrid::first_ratio, 1));
    while (true) {
        if (refine) {
            ratio_ = grid_.steps == 0 ? FloquetGrid::first_ratio : 2;
            grid_.steps = std::max(1, 2 * grid_.steps);
        }
        difference_ = std::move(product);
        fine_ = transitions_between(grid_.samples, grid_.steps);
        product = factors(fine_);
        for (std::size_t k = 0; k < difference_.size(); ++k) difference_[k] -= product[k];
        ProductEigen eigen;
        if (!eigen.compute(product))
            throw NumericalError("Floquet theory: the eigenvalue iteration on the monodromy matrix did not converge");
        analyse(eigen, result);
        result.steps = grid_.steps * grid_.samples * parts;
        // Half the steps leave a small part of an error. What does not fall comes from rounding in an ill-conditioned
        // mode (a free displacement that unbalance holds weakly), and steps to the limit would not change it.
        constexpr double min_gain = 4;
        const double left = worst(result.modes);
        const bool enough = left == 0 || left * min_gain > before;
        before = left;
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
