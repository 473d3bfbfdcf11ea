#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/anderson.hpp"
#include "solvers/periodic/detail/balance.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;
constexpr const char* in_harmonic_balance = "harmonic balance";
// What counts as converged if no step reduces the residual, which may be rounding.
constexpr double small_residual = 1e-8;
// Of coefficients, for which a step at once takes 30 MB; with more, kinks may leave ten times as much.
constexpr Index many = 2000;
constexpr double small_of_many = 1e-7;
// Steps with the mean Jacobian: where the residual falls to less than this, single ones do; where it does not fall to
// less than the other, the step is no use.
constexpr double good_reduction = 0.1, of_use = 0.5;
// Residual over stiffness of the harmonics that are left out, and of states over their scales; and what is enough to
// tell it.
constexpr double small_remainder = 1e-5, enough_for_remainder = 0.1 * small_remainder;
// States that follow curves with kinks, as those of airfoils do: further harmonics leave hardly less than before, and
// no more than this is left as it is.
constexpr double remainder_of_kinks = 2e-3, worth_more_harmonics = 0.5;

// Alike blades see the same azimuths, whatever acts on them there: as many in each part of the turn.
int usual_samples(const RotorMap* rotor, int harmonics) {
    const int enough = 4 * (harmonics + 1), parts = rotor ? std::max(1, static_cast<int>(rotor->blades.size())) : 1;
    return (enough + parts - 1) / parts * parts;
}

}  // namespace

Balance::Balance(const System& system, int spin, const PeriodicOptions& options)
    : options_(options), equations_(system, spin, options, in_harmonic_balance) {
    const int min = 2 * options.harmonics + 1;
    if (options.samples < 0 || (options.samples > 0 && options.samples < min))
        throw InputError(in_harmonic_balance, "number of samples", options.samples, text(">= ", min, ", or 0"));
    hold();
    x_ = equations_.start(options.harmonics);
    // Both know blades by their coordinates; multipliers would have to change places like these.
    if (options.rotor && system.loops.empty())
        mean_ = MeanJacobian::make(*options.rotor, equations_, options.harmonics);
    for (Index row : held_)
        if (mean_ && !mean_->hold(row)) mean_.reset();
    set_harmonics(options.harmonics);
    if (!system.loops.empty()) equations_.close(x_, std::max(at_->size(), 64));
}

// The first ones of the series stay as they are, and so does the Jacobian.
void Balance::set_harmonics(int harmonics) {
    const int usual = usual_samples(options_.rotor, harmonics);
    const bool more = harmonics > options_.harmonics;
    at_.emplace(harmonics, options_.samples > 0 && !more ? options_.samples : std::max(options_.samples, usual),
                options_.rotor_speed);
    const Index before = x_.cols();
    x_.conservativeResize(x_.rows(), 2 * harmonics + 1);
    if (before < x_.cols()) x_.rightCols(x_.cols() - before).setZero();
    R_.setZero(x_.rows(), x_.cols());
    if (mean_) mean_->set_harmonics(harmonics);
    slow_ = false;
    half_.reset();
    if (options_.rotor && equations_.system().loops.empty())
        half_ = HalfTurn::make(*options_.rotor, equations_, harmonics);
    for (Index row : held_)
        if (half_ && half_->mean_of(row) < 0) half_.reset();
}

void Balance::add_harmonics() {
    set_harmonics(2 * at_->harmonics);
    set_units();
    evaluate(x_, R_);
}

void Balance::hold() {
    for (int coordinate : options_.fixed_means) {
        const Index row = equations_.row_of(coordinate);
        if (row < 0)
            throw InputError(in_harmonic_balance, "coordinate whose mean is fixed", coordinate,
                             "a free coordinate besides the spin");
        held_.push_back(row);
    }
    for (const Index row : equations_.growing()) held_.push_back(row);
}

// Harmonic j is measured by j^2 times the inertia where that is more than the stiffness.
void Balance::set_units() {
    unit_.resize(x_.size());
    for (Index l = 0; l < x_.cols(); ++l) {
        const Index harmonic = (l + 1) / 2;
        const auto j = static_cast<double>(harmonic);
        unit_.segment(l * x_.rows(), x_.rows()) = (scale_ * std::max(1.0, j * j)).cwiseSqrt().cwiseInverse();
    }
}

void Balance::set_at(int sample, const Matrix& x) {
    if (options_.cancelled && options_.cancelled()) throw Cancelled();
    equations_.set_azimuth(entry(at_->azimuths, sample));
    equations_.set(x * at_->basis[0].col(sample), x * at_->basis[1].col(sample), x * at_->basis[2].col(sample));
}

// R = harmonics of the residual on the series x. False if it is not finite.
bool Balance::evaluate(const Matrix& x, Matrix& R) {
    Vector r(x.rows());
    R.setZero(x.rows(), x.cols());
    for (int s = 0; s < at_->size(); ++s) {
        set_at(s, x);
        equations_.residual(r);
        R += r * at_->weights.col(s).transpose();
    }
    return R.allFinite();
}

// Held means have no equation.
double Balance::largest(const Matrix& R) const {
    if (R.size() == 0) return 0;
    Matrix over = (R.array().colwise() / scale_.array()).abs();
    for (Index row : held_) over(row, 0) = 0;
    return over.allFinite() ? over.maxCoeff() : std::numeric_limits<double>::infinity();
}

double Balance::small() const {
    return x_.size() > many ? small_of_many : small_residual;
}

double Balance::norm(const Matrix& R) const {
    Matrix over = R.array().colwise() / scale_.array();
    for (Index row : held_) over(row, 0) = 0;
    return over.allFinite() ? over.norm() : std::numeric_limits<double>::infinity();
}

// Halves the step until the residual falls.
bool Balance::search(const Matrix& dx) {
    const double before = norm(R_);
    Matrix x, R;
    double part = 1;
    for (int halvings = 0; halvings < 20; ++halvings, part /= 2) {
        x = x_ + part * dx;
        if (!evaluate(x, R) || !(norm(R) <= (1 - 1e-4 * part) * before)) continue;
        x_ = x;
        R_ = R;
        return true;
    }
    why_ = "no part of Newton's step makes the residual smaller";
    return false;
}

// The mean Jacobian of this state.
void Balance::set_mean() {
    mean_->set(equations_, x_);
    stale_ = false;
}

// A step with the mean Jacobian; afterwards x_ is better by half at least, or unchanged.
bool Balance::mean_step() {
    Matrix dx, R;
    if (!mean_->step(R_, 0.1 * options_.tolerance, dx)) {
        mean_.reset();
        return false;
    }
    const Matrix x = x_ + dx;
    const double before = norm(R_), after = evaluate(x, R) ? norm(R) : std::numeric_limits<double>::infinity();
    slow_ = after > good_reduction * before;
    if (!(after < of_use * before)) return false;
    x_ = x;
    R_ = R;
    for (Index row : mean_->open()) open_.note(equations_, row, 0);
    return true;
}

// Steps with the mean Jacobian that learn from one another, where the equations change so much with the azimuth that a
// single one is no use.
bool Balance::accelerated_steps() {
    constexpr int max = 60, depth = 10, useless_steps = 2 * depth;
    constexpr double worth_it = 0.9;
    const double start = norm(R_);
    Anderson anderson(x_.size(), depth);
    Matrix x = x_, R = R_, dx;
    double best = start;
    int best_at = 0;
    for (int k = 0; k < max && k <= best_at + useless_steps && largest(R) > options_.tolerance; ++k) {
        if (!mean_->step(R, 0, dx, true)) break;
        const Vector next = anderson.next(x.reshaped(), dx.reshaped());
        x = next.reshaped(x.rows(), x.cols());
        if (!evaluate(x, R) || !(norm(R) < 1e3 * start)) break;
        if (!(norm(R) < best)) continue;
        if (norm(R) < worth_it * best) best_at = k;
        best = norm(R);
        x_ = x;
        R_ = R;
    }
    return best < of_use * start;
}

// Single steps as long as they are good, then accelerated ones; after these, the same with the Jacobian of this state,
// which costs as much as many steps. Of a small residual kinks keep a single step from being of use, too, and many
// coefficients are left with it.
bool Balance::mean_steps() {
    const bool fresh = stale_;
    if (stale_) set_mean();
    if (!slow_ && mean_step()) return true;
    if (!mean_ || (x_.size() > many && largest(R_) <= small())) return false;
    if (accelerated_steps()) return true;
    if (fresh) return false;
    set_mean();
    return mean_step() || (mean_ && largest(R_) > small_residual && accelerated_steps());
}

// False if nothing makes the residual smaller. What is small already is as good as the arithmetic, or kinks of what
// acts, allow: with many coefficients, a step for all at once would take their number squared in memory to find that
// out.
bool Balance::advance() {
    if (mean_ && mean_steps()) return true;
    if (mean_ && x_.size() > many && largest(R_) <= small()) return false;
    Matrix dx;
    return step(dx) && search(dx);
}

// If no step reduces it, a small residual is as good as the arithmetic allows.
bool Balance::converges(double tolerance) {
    bool moves = true;
    for (int k = 0; moves && !(largest(R_) <= tolerance) && k < options_.iterations; ++k, ++iterations_)
        moves = advance();
    return largest(R_) <= std::max(tolerance, moves ? 0 : small());
}

void Balance::set_remainders(PeriodicSteadyState& result) {
    equations_.set_remainders(x_, at_->size(), scale_, result);
    const bool kinks = result.state_remainder > worth_more_harmonics * left_before_;
    leaves_much_ =
        result.remainder > small_remainder || result.state_remainder > (kinks ? remainder_of_kinks : small_remainder);
}

// Harmonics that may not be the last ones need not be exact.
PeriodicSteadyState Balance::solve() {
    PeriodicSteadyState result;
    scale_ = equations_.scale(x_);
    set_units();
    bool small = evaluate(x_, R_);
    if (!small) why_ = "the residual at the start is not finite";
    while (small && more_are_allowed()) {
        small = converges(std::max(options_.tolerance, enough_for_remainder));
        set_remainders(result);
        if (!small || !leaves_much_) break;
        left_before_ = result.state_remainder;
        add_harmonics();
    }
    finish(result, small && converges(options_.tolerance));
    return result;
}

void Balance::finish(PeriodicSteadyState& result, bool small) {
    result.converged = small;
    equations_.finish(x_, result);
    result.residual = largest(R_);
    set_remainders(result);
    result.needs_more_harmonics = leaves_much_;
    result.iterations = iterations_;
    for (std::size_t i = 0; i < options_.fixed_means.size(); ++i)
        result.fixed_means.push_back({options_.fixed_means[i], R_(held_[i], 0)});
    for (const std::string& words : open_.words()) result.note += (result.note.empty() ? "" : "; ") + words;
    if (small) return;
    result.message = text(
        "periodic steady state at ", options_.rotor_speed, " rad/s not found after ", result.iterations,
        " iterations (residual over stiffness ", result.residual, ", wanted ", options_.tolerance, "): ", why_,
        open_.mean() ? "; the mean load on a coordinate that nothing holds does not vanish: hold its mean or add a "
                       "spring ("
                     : "; start from a neighbouring state, or take other harmonics",
        open_.mean() ? result.note + ")" : "");
}

PeriodicSteadyState harmonic_balance(const System& system, int spin, const PeriodicOptions& options) {
    try {
        return Balance(system, spin, options).solve();
    } catch (const Balance::Cancelled&) {
        PeriodicSteadyState none;
        none.converged = false;
        none.message = text("periodic steady state at ", options.rotor_speed, " rad/s: it was cancelled");
        return none;
    }
}

}  // namespace cardan::solvers
