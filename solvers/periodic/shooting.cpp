#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/radau.hpp"
#include "solvers/periodic/detail/rotor_equations.hpp"

#include <algorithm>
#include <limits>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;
constexpr const char* in_shooting = "shooting";

// Time is the azimuth here, rates and accelerations are by azimuth.
class Shooting {
public:
    Shooting(const System& system, int spin, const PeriodicOptions& options);
    PeriodicSteadyState solve();

private:
    bool revolve();
    bool step(double psi);
    bool stages(double psi);
    void evaluate(Index stage, double psi);
    Vector newton_step();
    bool search(const Vector& step);
    double miss() const;
    void finish(PeriodicSteadyState& result, bool small);

    PeriodicOptions options_;
    RotorEquations equations_;
    RadauIIA method_;
    RadauStage algebra_;
    int steps_;
    Vector start_, x_;      // (q, q', s), at azimuth 0 and after the steps made
    Matrix accelerations_;  // at the stages, by column; below them the rates of the states
    Vector scale_;          // of residuals
    Matrix right_;          // residuals at the stages
    Matrix transition_;     // derivative of x_ by start_
    Matrix of_step_;        // of x_ after a step by x_ before
    Matrix path_;           // positions, and states, at the beginnings of the steps
    SecondOrderSystem at_;
    std::string why_ = "the limit of iterations was reached";
    std::string note_;
};

void require_no_growth(const RotorEquations& equations) {
    if (const auto rows = equations.growing(); !rows.empty())
        throw InputError(in_shooting, text("kind of the state '", equations.name(rows[0]), "'"), "angle",
                         "one that comes back after a revolution (harmonic balance leaves its mean out)");
}

int number_of_steps(const PeriodicOptions& options) {
    if (!options.fixed_means.empty())
        throw InputError(in_shooting, "number of fixed means", options.fixed_means.size(),
                         "0 (harmonic balance can hold them)");
    const int steps = options.steps > 0 ? options.steps : std::max(64, 8 * options.harmonics);
    if (options.steps < 0 || steps < 2 * options.harmonics + 1)
        throw InputError(in_shooting, "steps per revolution", options.steps,
                         text(">= ", 2 * options.harmonics + 1, ", or 0"));
    return steps;
}

Shooting::Shooting(const System& system, int spin, const PeriodicOptions& options)
    : options_(options),
      equations_(system, spin, options, in_shooting),
      method_(options.stages),
      algebra_(method_, equations_.size(), equations_.states().size()),
      steps_(number_of_steps(options)),
      path_(equations_.size(), steps_) {
    system.require_no_loops(in_shooting);
    require_no_growth(equations_);
    const Index n = equations_.states_from(), m = equations_.states().size();
    const Index columns = std::max({options.start.cols(), options.state_start.cols(), Index{1}});
    const Matrix own = equations_.start(static_cast<int>(columns / 2));
    const int harmonics = static_cast<int>(own.cols() / 2);
    const Vector rates = own * fourier_basis(0, harmonics, 1);
    start_.resize(2 * n + m);
    start_ << own.topRows(n) * fourier_basis(0, harmonics), rates.head(n),
        own.bottomRows(m) * fourier_basis(0, harmonics);
    Vector accelerations = own * fourier_basis(0, harmonics, 2);
    accelerations.tail(m) = rates.tail(m);
    accelerations_.resize(n + m, method_.stages());
    accelerations_.colwise() = accelerations;
    scale_ = equations_.scale(own);
}

// Residual and derivatives at a stage, divided by the scale.
void Shooting::evaluate(Index stage, double psi) {
    const Index n = equations_.states_from(), m = equations_.states().size(), all = n + m;
    const double h = 2 * pi / steps_, Omega = equations_.rotor_speed();
    const auto v = x_.segment(n, n);
    const auto accelerations = accelerations_.topRows(n), state_rates = accelerations_.bottomRows(m);
    Vector position(all), rate(all), acceleration = Vector::Zero(all);
    position << x_.head(n) + method_.c(stage) * h * v + h * h * (accelerations * method_.A2.row(stage).transpose()),
        x_.tail(m) + h * (state_rates * method_.A.row(stage).transpose());
    rate << v + h * (accelerations * method_.A.row(stage).transpose()), state_rates.col(stage);
    acceleration.head(n) = accelerations.col(stage);
    equations_.set_azimuth(psi + method_.c(stage) * h);
    equations_.set(position, Omega * rate, Omega * Omega * acceleration);
    Vector r(all);
    equations_.residual(r);
    right_.block(stage * all, 0, all, 1) = -r.cwiseQuotient(scale_);
    equations_.linearise_all(at_);
    const auto unit = scale_.cwiseInverse().asDiagonal();
    algebra_.set(stage, h, Omega * Omega * (unit * at_.M), Omega * (unit * at_.C), unit * at_.K);
}

// Accelerations at the stages by Newton's method, begun from those of the step before.
bool Shooting::stages(double psi) {
    const Index n = equations_.size(), s = method_.stages();
    accelerations_.colwise() = Vector(accelerations_.col(s - 1));
    double last = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 25; ++i) {
        right_.resize(s * n, 1);
        for (Index stage = 0; stage < s; ++stage) evaluate(stage, psi);
        if (!right_.allFinite()) return false;
        algebra_.factorise();
        algebra_.solve(right_);
        accelerations_ += right_.reshaped(n, s);
        const double h = 2 * pi / steps_, change = h * right_.cwiseAbs().maxCoeff(),
                     size = 1 + h * accelerations_.cwiseAbs().maxCoeff();
        if (!std::isfinite(change)) return false;
        // Quadratic convergence: what comes next is rounding.
        if (change < 1e-9 * size || (change < 1e-6 * size && change > 0.5 * last)) return true;
        last = change;
    }
    return false;
}

bool Shooting::step(double psi) {
    const Index n = equations_.states_from(), m = equations_.states().size(), s = method_.stages();
    const double h = 2 * pi / steps_;
    if (!stages(psi)) {
        why_ = text("the integration fails at azimuth ", psi, " rad");
        return false;
    }
    algebra_.transition(h, of_step_);
    transition_ = (of_step_ * transition_).eval();
    const auto accelerations = accelerations_.topRows(n);
    x_.head(n) += h * x_.segment(n, n) + h * h * (accelerations * method_.A2.row(s - 1).transpose());
    x_.segment(n, n) += h * (accelerations * method_.A.row(s - 1).transpose());
    x_.tail(m) += h * (accelerations_.bottomRows(m) * method_.A.row(s - 1).transpose());
    return true;
}

bool Shooting::revolve() {
    const Index n = equations_.states_from(), m = equations_.states().size();
    x_ = start_;
    transition_.setIdentity(x_.size(), x_.size());
    for (int i = 0; i < steps_; ++i) {
        path_.col(i) << x_.head(n), x_.tail(m);
        if (!step(2 * pi * i / steps_)) return false;
    }
    return true;
}

double Shooting::miss() const {
    return x_.size() == 0 ? 0 : (x_ - start_).cwiseAbs().maxCoeff();
}

// Newton's step on x(2 pi) - x(0) = 0; the shortest one where a multiplier is 1, as far as the integration can tell.
Vector Shooting::newton_step() {
    const Matrix J = transition_ - Matrix::Identity(start_.size(), start_.size());
    const Eigen::JacobiSVD<Matrix> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const double min = 1e-9 * std::max(1.0, transition_.cwiseAbs().maxCoeff());
    const Vector& sizes = svd.singularValues();
    const Index rank = (sizes.array() > min).count(), missing = sizes.size() - rank;
    note_ = missing == 0 ? ""
                         : text(missing,
                                " Floquet multiplier(s) of 1: a motion that nothing holds, or a natural frequency at a "
                                "multiple of the rotor speed; the nearest periodic motion is taken");
    const Vector right = svd.matrixU().leftCols(rank).transpose() * (start_ - x_);
    return svd.matrixV().leftCols(rank) * right.cwiseQuotient(sizes.head(rank));
}

// Halves the step until the mismatch after one revolution falls; otherwise start_ is unchanged.
bool Shooting::search(const Vector& step) {
    const Vector from = start_;
    const double before = miss();
    double part = 1;
    for (int halvings = 0; halvings < 10; ++halvings, part /= 2) {
        start_ = from + part * step;
        if (revolve() && miss() < (1 - 1e-4 * part) * before) return true;
    }
    start_ = from;
    revolve();
    why_ = "no part of Newton's step leads nearer to where the revolution began";
    return false;
}

PeriodicSteadyState Shooting::solve() {
    PeriodicSteadyState result;
    bool possible = revolve();
    const bool begun = possible;
    while (possible && miss() > options_.tolerance && result.iterations < options_.iterations) {
        possible = search(newton_step());
        ++result.iterations;
    }
    if (begun) (void)newton_step();  // for the note
    // If no step improves it, a small mismatch is as good as the arithmetic allows.
    finish(result, begun && miss() <= std::max(options_.tolerance, possible ? 0 : 1e-8));
    return result;
}

void Shooting::finish(PeriodicSteadyState& result, bool small) {
    const Matrix own = fourier_coefficients(path_, options_.harmonics);
    result.converged = small;
    equations_.finish(own, result);
    result.residual = miss();
    equations_.set_remainders(own, 4 * (options_.harmonics + 1), scale_, result);
    result.note = note_;
    if (!small)
        result.message =
            text("periodic steady state at ", options_.rotor_speed, " rad/s not found after ", result.iterations,
                 " revolutions (misses its beginning by ", result.residual, ", wanted ", options_.tolerance,
                 "): ", why_, "; start from a neighbouring state, or take more steps per revolution");
}

}  // namespace

PeriodicSteadyState shooting(const System& system, int spin, const PeriodicOptions& options) {
    return Shooting(system, spin, options).solve();
}

}  // namespace cardan::solvers
