#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/anderson.hpp"
#include "solvers/periodic/detail/half_turn.hpp"
#include "solvers/periodic/detail/mean_jacobian.hpp"
#include "solvers/periodic/detail/rotor_equations.hpp"

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
constexpr double good_reduction = 0.1, least_reduction = 0.5;

// Unknowns are the coefficients column after column: entry l n + i is coefficient l of unknown i.
class Balance {
public:
    Balance(const System& system, int spin, const PeriodicOptions& options);
    PeriodicSteadyState solve();

private:
    int samples() const { return static_cast<int>(azimuths_.size()); }
    void hold();
    void set_scales();
    bool evaluate(const Matrix& x, Matrix& R);
    Matrix jacobian();
    Matrix half_jacobian();
    bool half_holds();
    double largest(const Matrix& R) const;
    double norm(const Matrix& R) const;
    double small() const { return x_.size() > many ? small_of_many : small_residual; }
    bool step(Matrix& dx);
    bool solve(Matrix& J, Vector& right, const Vector& unit, const std::vector<Index>& held);
    Vector shortest_solution(const Matrix& J, const Vector& right);
    void describe(const Vector& null_vector);
    void note_open(std::string words);
    void note_open_mean(Index row);
    bool search(const Matrix& dx);
    bool advance();
    void set_mean();
    bool mean_step();
    bool accelerated_steps();
    bool mean_steps();
    void finish(PeriodicSteadyState& result, bool small);

    PeriodicOptions options_;
    RotorEquations equations_;
    std::vector<double> azimuths_;
    Matrix basis_[3];  // by derivative, times the power of the rotor speed: a column per azimuth
    Matrix weights_;   // of the projection on the harmonics: a column per azimuth
    std::vector<Index> held_;
    std::optional<MeanJacobian> mean_;  // none: Newton's steps only
    std::optional<HalfTurn> half_;      // of two alike blades, as long as the residual has no other harmonics
    bool stale_ = true;                 // it has never been set
    bool slow_ = false;                 // its single steps are of little use
    Vector scale_, unit_;               // of residuals, per unknown; of entries for the linear system
    Matrix x_, R_;
    std::string why_ = "the limit of iterations was reached";
    std::vector<std::string> open_;  // what the equations do not determine
    bool open_mean_ = false;
};

// Alike blades see the same azimuths, whatever acts on them there: as many in each part of the turn.
int usual_samples(const PeriodicOptions& options) {
    const int enough = 4 * (options.harmonics + 1),
              parts = options.rotor ? std::max(1, static_cast<int>(options.rotor->blades.size())) : 1;
    return (enough + parts - 1) / parts * parts;
}

Balance::Balance(const System& system, int spin, const PeriodicOptions& options)
    : options_(options), equations_(system, spin, options, in_harmonic_balance) {
    const int least = 2 * options.harmonics + 1;
    const int count = options.samples > 0 ? options.samples : usual_samples(options);
    if (options.samples < 0 || count < least)
        throw InputError(in_harmonic_balance, "number of samples", options.samples, text(">= ", least, ", or 0"));
    const double Omega = options.rotor_speed;
    for (Matrix* m : {&basis_[0], &basis_[1], &basis_[2], &weights_}) m->resize(least, count);
    for (int s = 0; s < count; ++s) {
        azimuths_.push_back(2 * pi * s / count);
        for (int d = 0; d < 3; ++d)
            basis_[d].col(s) = std::pow(Omega, d) * fourier_basis(azimuths_.back(), options.harmonics, d);
        weights_.col(s) = fourier_weights(azimuths_.back(), options.harmonics, count);
    }
    hold();
    x_ = equations_.start(options.harmonics);
    if (!system.loops.empty()) equations_.close(x_, std::max(count, 64));
    // Both know blades by their coordinates; multipliers would have to change places like these.
    const bool blades = options.rotor && system.loops.empty();
    if (blades) mean_ = MeanJacobian::make(*options.rotor, equations_, options.harmonics);
    if (blades) half_ = HalfTurn::make(*options.rotor, equations_, options.harmonics);
    for (Index row : held_) {
        if (mean_ && !mean_->hold(row)) mean_.reset();
        if (half_ && half_->mean_of(row) < 0) half_.reset();
    }
    R_.setZero(x_.rows(), x_.cols());
}

void Balance::hold() {
    for (int coordinate : options_.held) {
        const Index row = equations_.row_of(coordinate);
        if (row < 0)
            throw InputError(in_harmonic_balance, "coordinate whose mean is held", coordinate,
                             "a free coordinate besides the spin");
        held_.push_back(row);
    }
    for (const Index row : equations_.growing()) held_.push_back(row);
}

// Harmonic j is measured by j^2 times the inertia where that is more than the stiffness.
void Balance::set_scales() {
    scale_ = equations_.scale(x_);
    unit_.resize(x_.size());
    for (Index l = 0; l < x_.cols(); ++l) {
        const Index harmonic = (l + 1) / 2;
        const auto j = static_cast<double>(harmonic);
        unit_.segment(l * x_.rows(), x_.rows()) = (scale_ * std::max(1.0, j * j)).cwiseSqrt().cwiseInverse();
    }
}

// R = harmonics of the residual on the series x. False if it is not finite.
bool Balance::evaluate(const Matrix& x, Matrix& R) {
    Vector r(x.rows());
    R.setZero(x.rows(), x.cols());
    for (int s = 0; s < samples(); ++s) {
        equations_.set_azimuth(entry(azimuths_, s));
        equations_.set(x * basis_[0].col(s), x * basis_[1].col(s), x * basis_[2].col(s));
        equations_.residual(r);
        R += r * weights_.col(s).transpose();
    }
    return R.allFinite();
}

// Block (k, l): mean over the azimuth of w_k (b''_l M + b'_l C + b_l K).
Matrix Balance::jacobian() {
    const Index n = x_.rows(), columns = x_.cols();
    Matrix J = Matrix::Zero(x_.size(), x_.size()), block(n, n);
    SecondOrderSystem at;
    for (int s = 0; s < samples(); ++s) {
        equations_.set_azimuth(entry(azimuths_, s));
        equations_.set(x_ * basis_[0].col(s), x_ * basis_[1].col(s), x_ * basis_[2].col(s));
        equations_.linearise_all(at);
        for (Index l = 0; l < columns; ++l) {
            block = basis_[2](l, s) * at.M + basis_[1](l, s) * at.C + basis_[0](l, s) * at.K;
            for (Index k = 0; k < columns; ++k) J.block(k * n, l * n, n, n) += weights_(k, s) * block;
        }
    }
    return J;
}

// Of the coefficients that two alike blades leave; the second half of the azimuths adds what the first one does.
Matrix Balance::half_jacobian() {
    Matrix J = Matrix::Zero(half_->size(), half_->size());
    SecondOrderSystem at;
    const int parts = samples() % 2 == 0 ? 2 : 1;
    for (int s = 0; s < samples() / parts; ++s) {
        equations_.set_azimuth(entry(azimuths_, s));
        equations_.set(x_ * basis_[0].col(s), x_ * basis_[1].col(s), x_ * basis_[2].col(s));
        equations_.linearise_all(at);
        half_->add(at, {basis_[0].col(s), basis_[1].col(s), basis_[2].col(s)}, parts * weights_.col(s), J);
    }
    return J;
}

// The blades may differ, and so may their start: once that is seen, all coefficients are unknowns.
bool Balance::half_holds() {
    if (!half_) return false;
    const Matrix residual = R_.array().colwise() / scale_.array();
    const bool start = half_->outside(x_) <= 1e-12 * x_.cwiseAbs().maxCoeff();
    if (!start || half_->outside(residual) > std::max(1e-3 * largest(R_), 0.1 * options_.tolerance)) half_.reset();
    return half_.has_value();
}

// Held means have no equation.
double Balance::largest(const Matrix& R) const {
    if (R.size() == 0) return 0;
    Matrix over = (R.array().colwise() / scale_.array()).abs();
    for (Index row : held_) over(row, 0) = 0;
    return over.allFinite() ? over.maxCoeff() : std::numeric_limits<double>::infinity();
}

double Balance::norm(const Matrix& R) const {
    Matrix over = R.array().colwise() / scale_.array();
    for (Index row : held_) over(row, 0) = 0;
    return over.allFinite() ? over.norm() : std::numeric_limits<double>::infinity();
}

// Newton's step.
bool Balance::step(Matrix& dx) {
    if (half_holds()) {
        Matrix J = half_jacobian();
        Vector y = half_->reduced(R_);
        Vector unit(y.size());
        for (Index i = 0; i < y.size(); ++i) unit(i) = unit_(half_->place(i));
        std::vector<Index> held;
        for (Index row : held_) held.push_back(half_->mean_of(row));
        if (!solve(J, y, unit, held)) return false;
        dx = half_->expanded(y);
    } else {
        Matrix J = jacobian();
        Vector y = R_.reshaped();
        if (!solve(J, y, unit_, held_)) return false;
        dx = y.reshaped(x_.rows(), x_.cols());
    }
    return dx.allFinite();
}

// r := -J^-1 r, by elimination or, if the Jacobian is singular, the shortest solution of all.
bool Balance::solve(Matrix& J, Vector& r, const Vector& unit, const std::vector<Index>& held) {
    J = (unit.asDiagonal() * J * unit.asDiagonal()).eval();
    if (!J.allFinite()) {
        why_ = "a derivative is not finite";
        return false;
    }
    r = -unit.cwiseProduct(r);
    for (Index row : held) {
        J.row(row).setZero();
        J.col(row).setZero();
        J(row, row) = 1;
        r(row) = 0;
    }
    const Eigen::PartialPivLU<Matrix> lu(J);
    r = reciprocal_condition(lu) > 1e-14 ? Vector(lu.solve(r)) : shortest_solution(J, r);
    r = unit.cwiseProduct(r).eval();
    return true;
}

Vector Balance::shortest_solution(const Matrix& J, const Vector& right) {
    Eigen::CompleteOrthogonalDecomposition<Matrix> qr;
    qr.setThreshold(1e-12);
    qr.compute(J);
    open_.clear();
    open_mean_ = false;
    const Index missing = J.rows() - qr.rank();
    if (missing > 0) {
        const Matrix null_space = qr.colsPermutation() * qr.matrixZ().transpose().rightCols(missing);
        for (Index i = 0; i < missing; ++i) describe(null_space.col(i));
    }
    return qr.solve(right);
}

void Balance::describe(const Vector& null_vector) {
    Index at = 0;
    null_vector.cwiseAbs().maxCoeff(&at);
    if (null_vector.size() < x_.size()) at = half_->place(at);
    const Index harmonic = (at / x_.rows() + 1) / 2;
    const Index row = at % x_.rows();
    const std::string& name = equations_.name(row);
    if (equations_.is_multiplier(row)) {
        note_open(text("the reaction '", name, "' is not unique: its equation is redundant"));
        return;
    }
    if (harmonic == 0)
        note_open_mean(row);
    else
        note_open(text("harmonic ", harmonic, " of '", name,
                       "' is not determined (a natural frequency at this multiple of the rotor speed)"));
}

void Balance::note_open_mean(Index row) {
    open_mean_ = true;
    note_open(text("the mean of '", equations_.name(row), "' is held by nothing and stays near where it started"));
}

void Balance::note_open(std::string words) {
    if (std::ranges::find(open_, words) == open_.end()) open_.push_back(std::move(words));
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
    if (!(after < least_reduction * before)) return false;
    x_ = x;
    R_ = R;
    for (Index row : mean_->open()) note_open_mean(row);
    return true;
}

// Steps with the mean Jacobian that learn from one another, where the equations change so much with the azimuth that a
// single one is no use.
bool Balance::accelerated_steps() {
    constexpr int most = 60, depth = 10, patience = 2 * depth;  // steps that hardly reduce the residual
    constexpr double worth_it = 0.9;
    const double start = norm(R_);
    Anderson anderson(x_.size(), depth);
    Matrix x = x_, R = R_, dx;
    double best = start;
    int best_at = 0;
    for (int k = 0; k < most && k <= best_at + patience && largest(R) > options_.tolerance; ++k) {
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
    return best < least_reduction * start;
}

// Single steps as long as they are good, then accelerated ones; after these, the same with the Jacobian of this state,
// which costs as much as many steps. Of a small residual kinks keep a single step from being of use, too.
bool Balance::mean_steps() {
    const bool fresh = stale_;
    if (stale_) set_mean();
    if (!slow_ && mean_step()) return true;
    if (mean_ && accelerated_steps()) return true;
    if (!mean_ || fresh) return false;
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

PeriodicSteadyState Balance::solve() {
    PeriodicSteadyState result;
    set_scales();
    bool finite = evaluate(x_, R_);
    if (!finite) why_ = "the residual at the start is not finite";
    while (finite && largest(R_) > options_.tolerance && result.iterations < options_.iterations) {
        finite = advance();
        ++result.iterations;
    }
    // If no step reduces it, a small residual is as good as the arithmetic allows.
    finish(result, largest(R_) <= std::max(options_.tolerance, finite ? 0 : small()));
    return result;
}

void Balance::finish(PeriodicSteadyState& result, bool small) {
    result.converged = small;
    equations_.finish(x_, result);
    result.residual = largest(R_);
    equations_.set_remainders(x_, samples(), scale_, result);
    for (std::size_t i = 0; i < options_.held.size(); ++i) result.held.push_back({options_.held[i], R_(held_[i], 0)});
    for (const std::string& words : open_) result.note += (result.note.empty() ? "" : "; ") + words;
    if (small) return;
    result.message =
        text("periodic steady state at ", options_.rotor_speed, " rad/s not found after ", result.iterations,
             " iterations (residual over stiffness ", result.residual, ", wanted ", options_.tolerance, "): ", why_,
             open_mean_ ? "; the mean load on a coordinate that nothing holds does not vanish: hold its mean or add a "
                          "spring ("
                        : "; start from a neighbouring state, or take other harmonics",
             open_mean_ ? result.note + ")" : "");
}

}  // namespace

PeriodicSteadyState harmonic_balance(const System& system, int spin, const PeriodicOptions& options) {
    return Balance(system, spin, options).solve();
}

}  // namespace cardan::solvers
