#include "mbs/base/error.hpp"
#include "solvers/time/detail/stepper.hpp"
#include "solvers/time/detail/tangent_factors.hpp"

#include <algorithm>
#include <limits>

namespace cardan::solvers {

namespace {

// Parameters of second order with the least dissipation of low frequencies at a given spectral radius at infinity.
//                                                                           [Chung and Hulbert 1993]
struct Alpha {
    explicit Alpha(double rho)
        : m((2 * rho - 1) / (rho + 1)),
          f(rho / (rho + 1)),
          gamma(0.5 - m + f),
          beta((1 - m + f) * (1 - m + f) / 4),
          error(beta + (m - f) / 2 - 1.0 / 6),
          m_states((3 * rho - 1) / (2 * (rho + 1))),
          gamma_states(0.5 - m_states + f) {}
    double m, f, gamma, beta;
    double error;  // of the positions after a step, over h^3 times the third derivative
    double m_states, gamma_states;
};

// The equations hold at the ends of the steps, so that a metric that varies does no harm; what the method averages is a
// second set of accelerations a:
//   (1 - m) a_1 + m a_0 = (1 - f) qdd_1 + f qdd_0
//   q_1  = q_0 + h qd_0 + h^2 ((1/2 - beta) a_0 + beta a_1)
//   qd_1 = qd_0 + h ((1 - gamma) a_0 + gamma a_1)
// a_0 stands for the acceleration at t_0 + (m - f) h.                  [Chung and Hulbert 1993; Arnold and Bruels 2007]
//
// States likewise, of first order, with their own m and gamma, which give the same spectral radius at infinity:
//   (1 - m) w_1 + m w_0 = (1 - f) sd_1 + f sd_0,   s_1 = s_0 + h ((1 - gamma) w_0 + gamma w_1)
//                                                                             [Jansen, Whiting and Hulbert 2000]
// Vectors of accelerations hold the rates of the states behind them.
class AlphaStepper : public Stepper {
public:
    AlphaStepper(EquationsOfMotion& equations, const IntegrationOptions& options);

    double time() const override { return time_; }
    void state_at(double time, double* x) override;
    IntegrationStatistics statistics() const override { return statistics_; }

private:
    void do_start(double time, const double* x, double stop) override;
    bool do_step(double horizon) override;
    void renew(double time, const double* x) override;
    void remember(double* memory) const override;
    void do_resume(double time, const double* x, double stop, const double* memory) override;
    struct End {
        Vector x, qdd, a;
    };
    bool controlled() const { return fixed_step_ == 0; }
    double first_step(double horizon);
    double trial_step() const;
    bool fail(std::string_view why, double h);
    void predict(double h);
    enum class Tangent : std::uint8_t { kept, fresh };
    bool iterate(double h);
    bool iterate(double h, Tangent tangent);
    void form_matrix(double h);
    void recall_matrix(const double* memory);
    // d qdd / d q and d qd / d q at the end of a step.
    double per_position(double h) const { return (1 - alpha_.m) / ((1 - alpha_.f) * alpha_.beta * h * h); }
    double per_rate(double h) const { return alpha_.gamma / (alpha_.beta * h); }
    // d s_rate / d s.
    double per_state(double h) const { return (1 - alpha_.m_states) / ((1 - alpha_.f) * alpha_.gamma_states * h); }
    void correct(double h);
    double error(double h);
    double weighted_norm() const;
    void accept(double h);
    void propose(double h, double e);

    EquationsOfMotion& equations_;
    ErrorWeights weights_;
    Alpha alpha_;
    Eigen::Index m_, k_;  ///< numbers of unknown coordinates and of states
    double max_step_, wanted_first_, fixed_step_;
    double time_ = 0, begin_ = 0, stop_ = 0, next_ = 0, last_ = 0;
    End from_, to_;
    Vector a_start_, jerk_, change_, w_, errors_;
    bool has_jerk_ = false;
    TangentFactors matrix_;
    // Where the matrix was formed, and for what step; 0: it has to be formed anew.
    struct Formed {
        double step = 0, time = 0;
        Vector x, qdd, u, driven;
    } formed_;
    double contraction_ = 1;  ///< of the iteration with the matrix
    IntegrationStatistics statistics_;
};

AlphaStepper::AlphaStepper(EquationsOfMotion& equations, const IntegrationOptions& options)
    : Stepper(equations.length(), step_memory(equations)),
      equations_(equations),
      weights_(equations, options.tolerances),
      alpha_(options.spectral_radius),
      m_(equations.size()),
      k_(equations.states()),
      max_step_(options.max_step > 0 ? options.max_step : std::numeric_limits<double>::max()),
      wanted_first_(options.first_step),
      fixed_step_(options.fixed_step),
      matrix_(equations) {
    for (End* end : {&from_, &to_}) {
        end->x.setZero(2 * m_ + k_);
        end->qdd.setZero(m_ + k_);
        end->a.setZero(m_ + k_);
    }
    for (Vector* v : {&a_start_, &jerk_, &change_}) v->setZero(m_ + k_);
    for (Vector* v : {&w_, &errors_}) v->setZero(2 * m_ + k_);
    formed_.x.setZero(2 * m_ + k_);
    formed_.qdd.setZero(m_ + k_);
    formed_.u = equations.inputs();
    formed_.driven.setZero(3 * std::ssize(equations.drives()));
    statistics_.order = 2;
}

void AlphaStepper::do_start(double time, const double* x, double stop) {
    time_ = begin_ = time;
    stop_ = stop;
    std::copy_n(x, to_.x.size(), to_.x.data());
    ++statistics_.evaluations;
    if (!equations_.accelerations(time, x, to_.qdd.data()))
        throw NumericalError(text("time integration: no start at ", time, " s: ", equations_.problem()));
    to_.a = to_.qdd;
    last_ = next_ = 0;
    has_jerk_ = false;
    formed_.step = 0;  // forces may have changed
}

void AlphaStepper::renew(double time, const double* x) {
    ++statistics_.evaluations;
    if (!equations_.accelerations(time, x, to_.qdd.data()))
        throw NumericalError(text("time integration: no forces at ", time, " s: ", equations_.problem()));
    to_.a = to_.qdd;
    last_ = 0;
    has_jerk_ = false;
}

// The step to come, the last one, whether there is a derivative of the accelerations; both accelerations and that; the
// matrix.
void AlphaStepper::remember(double* memory) const {
    memory[0] = controlled() ? next_ : fixed_step_;
    memory[2] = last_;
    memory[3] = has_jerk_ ? 1 : 0;
    Eigen::Map<Vector>(memory + 4, 3 * (m_ + k_)) << to_.qdd, to_.a, jerk_;
    double* out = memory + 4 + 3 * (m_ + k_);
    for (const double number : {formed_.step, formed_.time, contraction_}) *out++ = number;
    for (const Vector* part : {&formed_.x, &formed_.qdd, &formed_.u, &formed_.driven})
        out = std::copy(part->begin(), part->end(), out);
}

void AlphaStepper::do_resume(double time, const double* x, double stop, const double* memory) {
    time_ = begin_ = time;
    stop_ = stop;
    std::copy_n(x, to_.x.size(), to_.x.data());
    next_ = memory[0];
    last_ = memory[2];
    has_jerk_ = memory[3] > 0;
    const Eigen::Index size = m_ + k_;
    const Eigen::Map<const Vector> accelerations(memory + 4, 3 * size);
    to_.qdd = accelerations.head(size);
    to_.a = accelerations.segment(size, size);
    jerk_ = accelerations.tail(size);
    recall_matrix(memory + 4 + 3 * size);
}

// The matrix that was remembered, to the last digit: the one that there is, or formed anew.
void AlphaStepper::recall_matrix(const double* memory) {
    const double step = memory[0], time = memory[1], *in = memory + 3;
    bool same = step == formed_.step && time == formed_.time;
    for (Vector* part : {&formed_.x, &formed_.qdd, &formed_.u, &formed_.driven}) {
        same = std::equal(part->begin(), part->end(), in) && same;
        std::copy_n(in, part->size(), part->data());
        in += part->size();
    }
    formed_.step = step;
    formed_.time = time;
    contraction_ = memory[2];
    if (same || step == 0) return;
    const Vector inputs = equations_.inputs();
    equations_.set_inputs(formed_.u);
    if (equations_.residual(time, formed_.x.data(), formed_.qdd.data(), formed_.driven.data(), change_.data()))
        form_matrix(step);
    else
        formed_.step = 0;
    equations_.set_inputs(inputs);
}

// So short that the acceleration moves nothing by more than the tolerance; it grows fast.
double AlphaStepper::first_step(double horizon) {
    // An output time very close to now says nothing about the step size.
    const double towards = std::min(horizon, stop_) - time_, shortest = 1e-6 * std::abs(time_);
    const double longest = std::min(max_step_, std::isfinite(towards) && towards > shortest ? towards : 1.0);
    if (wanted_first_ > 0) return std::min(wanted_first_, longest);
    double largest = 0;
    for (Eigen::Index i = 0; i < m_; ++i) largest = std::max(largest, std::abs(to_.qdd(i) * w_(i)));
    double first = largest > 0 ? std::min(longest, 1 / std::sqrt(largest)) : 1e-3 * longest;
    for (Eigen::Index i = m_; i < m_ + k_; ++i) first = std::min(first, 1 / std::abs(to_.qdd(i) * w_(m_ + i)));
    return first;
}

// Ends exactly at the stop, and leaves no tiny remainder before it.
double AlphaStepper::trial_step() const {
    const double h = controlled() ? std::min(next_, max_step_) : fixed_step_, left = stop_ - time_;
    if (h >= left * (1 - 1e-10)) return left;
    return controlled() && 2 * h > left ? left / 2 : h;
}

bool AlphaStepper::fail(std::string_view why, double h) {
    failure_ = text("no step possible at ", time_, " s: ", why, " (step ", h, " s)");
    if (!equations_.problem().empty()) failure_ += text("; ", equations_.problem());
    const LimitingEntry worst = limiting_entry(errors_.data(), w_.data(), static_cast<int>(w_.size()));
    if (worst.entry >= 0 && worst.error > informative)
        failure_ += text("; the largest local error or correction, ", worst.error, " times the allowed one, has the ",
                         equations_.name_of(worst.entry));
    failure_ += "; look for jumps of forces (give their times as breaks), or take shorter steps";
    return false;
}

void AlphaStepper::correct(double h) {
    const auto q0 = from_.x.head(m_), qd0 = from_.x.segment(m_, m_);
    const auto a0 = a_start_.head(m_);
    auto a1 = to_.a.head(m_);
    a1 = ((1 - alpha_.f) * to_.qdd.head(m_) + alpha_.f * from_.qdd.head(m_) - alpha_.m * a0) / (1 - alpha_.m);
    to_.x.head(m_) = q0 + h * qd0 + h * h * ((0.5 - alpha_.beta) * a0 + alpha_.beta * a1);
    to_.x.segment(m_, m_) = qd0 + h * ((1 - alpha_.gamma) * a0 + alpha_.gamma * a1);
    if (k_ == 0) return;
    const auto w0 = a_start_.tail(k_);
    auto w1 = to_.a.tail(k_);
    w1 = ((1 - alpha_.f) * to_.qdd.tail(k_) + alpha_.f * from_.qdd.tail(k_) - alpha_.m_states * w0) /
         (1 - alpha_.m_states);
    to_.x.tail(k_) = from_.x.tail(k_) + h * ((1 - alpha_.gamma_states) * w0 + alpha_.gamma_states * w1);
}

void AlphaStepper::predict(double h) {
    // With another step a_0 has to stand for another time.
    a_start_ = from_.a;
    if (last_ > 0) a_start_ = from_.qdd + h / last_ * (from_.a - from_.qdd);
    to_.qdd = from_.qdd;
    if (has_jerk_) to_.qdd += h * jerk_;
    correct(h);
}

// The tangent by the positions at the end, at the last residual.
void AlphaStepper::form_matrix(double h) {
    equations_.linearise_residual();
    matrix_.form({.qdd = per_position(h), .qd = per_rate(h), .q = 1, .s_rate = per_state(h), .s = 1});
}

// Newton's method for the accelerations at the end, in terms of the positions there. The matrix is kept from step to
// step as long as the iteration contracts well with it.
bool AlphaStepper::iterate(double h) {
    if (formed_.step > 0 && std::abs(h / formed_.step - 1) < 0.3) {
        if (iterate(h, Tangent::kept)) return true;
        predict(h);
    }
    return iterate(h, Tangent::fresh);
}

bool AlphaStepper::iterate(double h, Tangent tangent) {
    double norm_before = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 12; ++i) {
        ++statistics_.evaluations;
        ++statistics_.iterations;
        if (!equations_.residual(begin_ + h, to_.x.data(), to_.qdd.data(), change_.data())) return false;
        // How well it contracts with a new one is known after the next.
        if (tangent == Tangent::fresh && (i == 0 || (i > 1 && contraction_ > 0.3))) {
            form_matrix(h);
            formed_.step = h;
            formed_.time = begin_ + h;
            formed_.x = to_.x;
            formed_.qdd = to_.qdd;
            formed_.u = equations_.inputs();
            equations_.driven_state(formed_.driven.data());
            contraction_ = 1;
            ++statistics_.jacobians;
            ++statistics_.factorisations;
        }
        matrix_.solve(change_);
        if (!change_.allFinite()) return false;
        // What dominates a matrix of another step grows with 1/h^2: half of that is made up for.
        change_ *= 2 / (1 + per_position(h) / per_position(formed_.step));
        to_.qdd.head(m_) -= per_position(h) * change_.head(m_);
        to_.qdd.tail(k_) -= per_state(h) * change_.tail(k_);
        correct(h);
        errors_.head(m_) = change_.head(m_);
        errors_.segment(m_, m_) = per_rate(h) * change_.head(m_);
        errors_.tail(k_) = change_.tail(k_);
        const double norm = weighted_norm();
        if (i > 0) contraction_ = std::max(0.3 * contraction_, norm / norm_before);
        if (norm * std::min(1.0, contraction_) < 1e-3) return true;
        if (i > 0 && contraction_ > (tangent == Tangent::kept ? 0.5 : 2.0)) return false;
        norm_before = norm;
    }
    return false;
}

// Weighted norm of the local error. Positions: the leading term, with the change of a for the third derivative. Rates:
// that of the trapezoidal rule, and by how much the method differs from it.
double AlphaStepper::error(double h) {
    errors_.head(m_) = alpha_.error * h * h * (to_.a - a_start_).head(m_);
    auto rates = errors_.tail(m_ + k_);
    rates = to_.x.tail(m_ + k_) - from_.x.tail(m_ + k_) - h / 2 * (from_.qdd + to_.qdd);
    if (has_jerk_)
        rates =
            rates.cwiseAbs() + h * h * h / 12 * (((to_.qdd - from_.qdd) / h - jerk_) / ((h + last_) / 2)).cwiseAbs();
    return weighted_norm();
}

double AlphaStepper::weighted_norm() const {
    return std::sqrt(errors_.cwiseProduct(w_).squaredNorm() / static_cast<double>(w_.size()));
}

void AlphaStepper::accept(double h) {
    jerk_ = (to_.qdd - from_.qdd) / h;
    has_jerk_ = true;
    time_ = h == stop_ - begin_ ? stop_ : begin_ + h;
    last_ = statistics_.last_step = h;
    ++statistics_.steps;
}

// A step shortened to end at a break does not invalidate the longer one that had been proposed.
void AlphaStepper::propose(double h, double e) {
    const double longer = h * std::clamp(0.9 / std::cbrt(e + 1e-9), 0.3, 3.0);
    // Little is gained by a step that is a little longer, and the matrix would have to follow.
    const double next = longer > h && longer < 1.2 * h ? h : longer;
    next_ = next_ > h ? std::max(next_, next) : next;
}

bool AlphaStepper::do_step(double horizon) {
    equations_.clear_problem();
    from_.x = to_.x;
    from_.qdd = to_.qdd;
    from_.a = to_.a;
    begin_ = time_;
    weights_.set(from_.x.data(), w_.data());
    if (controlled() && next_ == 0) next_ = first_step(horizon);
    double h = trial_step();
    std::string_view why = "the iteration did not converge";
    for (;; h = trial_step()) {
        predict(h);
        const bool converged = iterate(h);
        const double e = converged && controlled() ? error(h) : 0;
        const bool stands = h != stop_ - begin_ && stands_still(begin_, begin_ + h);
        if (converged && e <= 1 && !stands) {
            accept(h);
            if (controlled()) propose(h, e);
            return true;
        }
        ++(converged ? statistics_.rejected : statistics_.not_converged);
        if (stands) why = standstill;
        if (stands || !controlled()) break;
        next_ = h * (converged ? std::clamp(0.9 / std::cbrt(std::min(e, 1e6)), 0.2, 0.8) : 0.25);
    }
    to_.x = from_.x;
    to_.qdd = from_.qdd;
    to_.a = from_.a;
    return fail(why, h);
}

// Hermite's cubics: positions through positions and rates, rates through rates and accelerations.
void AlphaStepper::state_at(double time, double* x) {
    const double h = time_ - begin_;
    Eigen::Map<Vector> out(x, w_.size());
    if (h <= 0 || time == time_) {
        out = to_.x;
        return;
    }
    if (time == begin_) {
        out = from_.x;
        return;
    }
    const double s = (time - begin_) / h, u = 1 - s;
    const double f0 = u * u * (1 + 2 * s), f1 = s * s * (1 + 2 * u), g0 = h * s * u * u, g1 = -h * s * s * u;
    out.head(m_) =
        f0 * from_.x.head(m_) + f1 * to_.x.head(m_) + g0 * from_.x.segment(m_, m_) + g1 * to_.x.segment(m_, m_);
    const Eigen::Index rest = m_ + k_;
    out.tail(rest) = f0 * from_.x.tail(rest) + f1 * to_.x.tail(rest) + g0 * from_.qdd + g1 * to_.qdd;
}

}  // namespace

std::unique_ptr<Stepper> make_alpha_stepper(EquationsOfMotion& equations, const IntegrationOptions& options) {
    return std::make_unique<AlphaStepper>(equations, options);
}

}  // namespace cardan::solvers
