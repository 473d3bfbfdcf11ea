#include "solvers/time/detail/newton_help.hpp"
#include "solvers/time/detail/stepper_sundials.hpp"

#include <algorithm>
#include <arkode/arkode_arkstep.h>
#include <utility>

namespace cardan::solvers {

namespace {

void free_arkode(void* memory) {
    ARKStepFree(&memory);
}

constexpr double largest_growth = 20;  // of a step that is not the first, the library's own

class ArkodeStepper : public SundialsStepper {
public:
    ArkodeStepper(EquationsOfMotion& equations, const IntegrationOptions& options);

    double time() const override { return time_; }
    void state_at(double time, double* x) override;

private:
    void do_start(double time, const double* x, double stop) override {
        after_break_ = 0;
        is_break_ = false;
        begin_at(time, x, stop, 0);
    }
    bool do_step(double horizon) override;
    void remember(double* memory) const override;
    void do_resume(double time, const double* x, double stop, const double* memory) override;
    void begin_at(double time, const double* x, double stop, double next_step);
    static int linear_system(realtype t, N_Vector x, N_Vector, SUNMatrix, SUNMatrix, booleantype old_will_do,
                             booleantype* is_new, realtype c, void* user, N_Vector, N_Vector, N_Vector) {
        auto& self = *static_cast<ArkodeStepper*>(static_cast<SundialsStepper*>(user));
        const bool keep = std::exchange(self.keep_jacobian_, false);
        return self.form_matrix(t, x, c, keep || old_will_do ? SUNTRUE : SUNFALSE, is_new);
    }
    static int next_step(N_Vector, realtype t, realtype h, realtype, realtype, realtype e1, realtype e2, realtype e3,
                         int, int p, realtype* next, void* user);
    static int predict(realtype t, N_Vector guess, void* user) {
        return static_cast<ArkodeStepper*>(static_cast<SundialsStepper*>(user))->predict_stage(t, guess);
    }
    int predict_stage(double t, N_Vector guess);
    static int rates_once(realtype t, N_Vector x, N_Vector xd, void* user);
    static double part_of(double left, double planned);
    void set_up(const IntegrationOptions& options);
    bool set_up_newton(void* ark);
    void complete_ends();
    void complete_states();
    void interpolate(double s, double* x) const;
    IntegrationStatistics since_start() const override;
    bool local_errors() override;
    ARKRhsFn explicit_rates() const { return implicit_ ? nullptr : rates_once; }
    ARKRhsFn implicit_rates() const { return implicit_ ? rates_once : nullptr; }

    bool implicit_;
    double fixed_step_;
    double planned_ = 0;      ///< s, the next step but for the stop; 0: not known
    double after_break_ = 0;  ///< s, likewise of a first step after a break, by the last one; 0: none yet
    bool is_break_ = false;   ///< where the next step begins
    bool failed_ = false;     ///< the last attempt at a step
    bool keep_jacobian_ = false;
    bool guesses_ = false;  ///< of stages by stages_
    Renewal renewal_;
    StageGuess stages_;
    struct End {
        double time = 0;
        Vector x, xdd;
        bool known = false;  ///< the accelerations and rates of states
    };
    End from_, to_;
    Vector quartic_;  ///< of the states' interpolation
    bool quartic_known_ = false;
    Vector between_, between_rates_;  ///< x and xdd within the step
    std::unique_ptr<void, SundialsDeleter<free_arkode>> arkode_;
};

ArkodeStepper::ArkodeStepper(EquationsOfMotion& equations, const IntegrationOptions& options)
    : SundialsStepper("ARKODE", equations, options, step_memory(equations)),
      implicit_(options.method == Method::dirk),
      fixed_step_(options.fixed_step) {
    for (End* end : {&from_, &to_}) {
        end->x.setZero(weights_.size());
        end->xdd.setZero(equations.rates());
    }
    quartic_.setZero(equations.states());
    stages_.resize(weights_.size());
    between_.setZero(weights_.size());
    between_rates_.setZero(equations.rates());
    set_up(options);
}

void ArkodeStepper::set_up(const IntegrationOptions& options) {
    arkode_.reset(ARKStepCreate(explicit_rates(), implicit_rates(), 0, vector(), context()));
    void* ark = arkode_.get();
    SundialsStepper* user = this;
    const auto implicit_table = implicit_ ? ARKODE_ESDIRK547L2SA_7_4_5 : ARKODE_DIRK_NONE;
    const auto explicit_table = implicit_ ? ARKODE_ERK_NONE : ARKODE_DORMAND_PRINCE_7_4_5;
    bool ok = ark && ARKStepSetErrHandlerFn(ark, sundials_quiet, nullptr) == 0 && ARKStepSetUserData(ark, user) == 0 &&
              ARKStepSetTableNum(ark, implicit_table, explicit_table) == 0 && ARKStepWFtolerances(ark, weights) == 0 &&
              ARKStepSetMaxHnilWarns(ark, -1) == 0 && ARKStepSetMaxStep(ark, options.max_step) == 0;
    if (fixed_step_ > 0) ok = ok && ARKStepSetFixedStep(ark, fixed_step_) == 0;
    ok = ok && ARKStepSetAdaptivityFn(ark, next_step, this) == 0;
    if (implicit_) ok = ok && set_up_newton(ark);
    if (equations_.loops()) ok = ok && ARKStepSetPostprocessStepFn(ark, project) == 0;
    if (!ok) throw NumericalError("SUNDIALS: ARKODE could not be set up");
}

// The stages are solved well below the tolerance: what the iteration leaves of the stiff parts would be taken for an
// error of the step. Then the rates can follow from the stages and cost no evaluations of their own.
bool ArkodeStepper::set_up_newton(void* ark) {
    use_newton();
    bool ok = ARKStepSetLinearSolver(ark, newton_->solver(), newton_->matrix()) == 0 &&
              ARKStepSetLinSysFn(ark, linear_system) == 0 && ARKStepSetNonlinConvCoef(ark, 0.003) == 0 &&
              ARKStepSetMaxNonlinIters(ark, 8) == 0 && ARKStepSetDeduceImplicitRhs(ark, SUNTRUE) == 0 &&
              ARKStepSetPredictorMethod(ark, 1) == 0 && ARKStepSetStagePredictFn(ark, predict) == 0 &&
              ARKStepSetInterpolantDegree(ark, 3) == 0;
    // With a fixed step a failed iteration cannot be retried with a shorter one: fresh matrices, more iterations.
    if (fixed_step_ > 0)
        ok = ok && ARKStepSetMaxNonlinIters(ark, 12) == 0 && ARKStepSetLSetupFrequency(ark, 1) == 0 &&
             ARKStepSetJacEvalFrequency(ark, 1) == 0;
    return ok;
}

// The step control starts afresh with the length of the next step, within the bounds of steps that are not the first; a
// jump excites fast motions, and the first step after it is as long as the last jump allowed.
void ArkodeStepper::remember(double* memory) const {
    memory[0] = fixed_step_ > 0 ? fixed_step_ : planned_;
    memory[2] = after_break_;
    if (!newton_) return;
    renewal_.remember(memory + 3);
    newton_->remember(memory + 3 + Renewal::memory);
}

// A fixed step has fresh matrices.
void ArkodeStepper::do_resume(double time, const double* x, double stop, const double* memory) {
    after_break_ = memory[2];
    is_break_ = memory[1] == has_gone_on && fixed_step_ == 0;
    begin_at(time, x, stop, is_break_ && after_break_ > 0 ? std::min(memory[0], after_break_) : memory[0]);
    if (!newton_ || fixed_step_ > 0) return;
    renewal_.recall(memory + 3);
    newton_->recall(memory + 3 + Renewal::memory);
    keep_jacobian_ = newton_->has_jacobian() && !renewal_.due();
}

// @param next_step  0: a start, where the library looks for the first step itself
void ArkodeStepper::begin_at(double time, const double* x, double stop, double next_step) {
    begin(time, x, stop);
    planned_ = next_step;
    failed_ = false;
    keep_jacobian_ = false;
    guesses_ = next_step > 0;
    to_.time = from_.time = time;
    to_.known = from_.known = quartic_known_ = false;
    std::copy(x, x + weights_.size(), to_.x.data());
    void* ark = arkode_.get();
    bool ok = ARKStepReInit(ark, explicit_rates(), implicit_rates(), time, vector()) == 0;
    if (fixed_step_ == 0) {
        const double first = next_step > 0 ? part_of(stop - time, next_step) : std::min(first_step_, stop - time);
        ok = ok && ARKStepSetMaxFirstGrowth(ark, next_step > 0 ? largest_growth : 0) == 0 &&
             ARKStepSetInitStep(ark, first) == 0;
    }
    if (std::isfinite(stop)) ok = ok && ARKStepSetStopTime(ark, stop) == 0;
    if (!ok) throw NumericalError("SUNDIALS: ARKODE could not be started");
}

// As many equal steps as it takes to the stop, which may be a little longer than planned: the error test has the last
// word.
double ArkodeStepper::part_of(double left, double planned) {
    constexpr double longer = 1.1;
    const double parts = std::ceil(left / (longer * planned));
    return parts < 16 ? left / parts : planned;
}

// The library's own control of the step [Kennedy and Carpenter 2019, PID], of which it does not tell what it would take
// but for the stop: a step shortened to end there does not invalidate the longer one. As there, a step that would
// hardly grow stays, and so does one that has followed a failed attempt.
int ArkodeStepper::next_step(N_Vector, realtype t, realtype h, realtype, realtype, realtype e1, realtype e2,
                             realtype e3, int, int p, realtype* next, void* user) {
    constexpr double k1 = 0.58, k2 = 0.21, k3 = 0.1, min = 1e-10, safety = 0.96, bias = 1.5, hardly = 1.5;
    auto& self = *static_cast<ArkodeStepper*>(user);
    *next = h * std::pow(std::max(e1, min), -k1 / p) * std::pow(std::max(e2, min), k2 / p) *
            std::pow(std::max(e3, min), -k3 / p);
    double planned = std::clamp(safety * *next, h / 10, largest_growth * h);
    const bool accepted = e1 <= bias, to_stop = std::abs(t - self.stop_) <= resolution(t);
    if (accepted && std::exchange(self.is_break_, false)) self.after_break_ = planned;
    if (accepted && planned >= h && (planned <= hardly * h || self.failed_)) planned = h;
    self.failed_ = !accepted;
    self.planned_ = accepted && to_stop ? std::max(self.planned_, planned) : planned;
    return 0;
}

bool ArkodeStepper::do_step(double horizon) {
    equations_.clear_problem();
    const double from = time_;
    const long solutions = newton_ ? newton_->solutions : 0, jacobians = newton_ ? newton_->jacobians : 0;
    const int flag = ARKStepEvolve(arkode_.get(), towards(horizon), vector(), &time_, ARK_ONE_STEP);
    rethrow();
    if (flag < 0 || (time_ != stop_ && stands_still(from, time_))) {
        time_ = from;
        failure_ = explain(flag,
                           "jumps of forces (give their times as breaks), a step too long for the explicit method or a "
                           "motion that ends in infinity");
        return false;
    }
    guesses_ = false;
    stages_.end();
    if (newton_) renewal_.add(newton_->solutions - solutions, newton_->jacobians > jacobians);
    std::swap(from_, to_);
    to_.time = time_;
    to_.known = quartic_known_ = false;
    std::copy(data(), data() + weights_.size(), to_.x.data());
    return true;
}

// What is known at the end of the last step, where work was integrated, is not evaluated again at the start of the
// next.
int ArkodeStepper::rates_once(realtype t, N_Vector x, N_Vector xd, void* user) {
    auto& self = *static_cast<ArkodeStepper*>(static_cast<SundialsStepper*>(user));
    End& end = self.to_;
    const Eigen::Index m = self.equations_.size();
    const double* in = N_VGetArrayPointer(x);
    double* out = N_VGetArrayPointer(xd);
    const bool there = t == end.time && std::equal(end.x.begin(), end.x.end(), in);
    if (there && end.known) {
        std::copy(in + m, in + 2 * m, out);
        std::copy(end.xdd.begin(), end.xdd.end(), out + m);
    } else {
        if (const int flag = rates(t, x, xd, user); flag != 0) return flag;
        if (there) {
            std::copy_n(out + m, end.xdd.size(), end.xdd.data());
            end.known = true;
        }
    }
    if (there && self.guesses_) self.stages_.begin(t, in, out);
    return 0;
}

// The library guesses stages by the step before. After a break or a sample it has none.
int ArkodeStepper::predict_stage(double t, N_Vector guess) {
    N_Vector last = nullptr;
    if (ARKStepGetCurrentState(arkode_.get(), &last) != 0) return -1;
    stages_.predict(t, N_VGetArrayPointer(last), N_VGetArrayPointer(guess));
    return 0;
}

// Both ends of the last step with their accelerations, evaluated where they are wanted for the first time.
void ArkodeStepper::complete_ends() {
    for (End* end : {&from_, &to_}) {
        if (end->known) continue;
        if (!equations_.accelerations(end->time, end->x.data(), end->xdd.data()))
            throw NoState(text("time integration: ", equations_.problem()));
        end->known = true;
    }
    if (!std::exchange(quartic_known_, true) && equations_.states() > 0) complete_states();
}

// Hermite's cubic in the states is of order 4 in the step, one less than the rates of the motion. The rates of the
// states at a fifth place, found with the cubic there, make it a quartic: where the derivative of s^2 (1 - s)^2 is
// largest.
void ArkodeStepper::complete_states() {
    constexpr double place = 0.21132486540518712, slope = 0.19245008972987526;  // (1 - 3^-1/2) / 2, and there
    quartic_.setZero();
    interpolate(place, between_.data());
    const double h = to_.time - from_.time;
    if (!equations_.accelerations(from_.time + place * h, between_.data(), between_rates_.data()))
        throw NoState(text("time integration: ", equations_.problem()));
    const Eigen::Index m = equations_.size(), k = equations_.states();
    const double s = place, u = 1 - s;
    for (Eigen::Index i = 0; i < k; ++i) {
        const double rise = to_.x(2 * m + i) - from_.x(2 * m + i), r0 = from_.xdd(m + i), r1 = to_.xdd(m + i);
        const double cubic = 6 * s * u * rise / h + u * (1 - 3 * s) * r0 + s * (3 * s - 2) * r1;
        quartic_(i) = h * (between_rates_(m + i) - cubic) / slope;
    }
}

// Hermite's quintic through positions, rates and accelerations at both ends, and its derivative: of order 5 in the
// rates, one evaluation per step. ARKODE's own interpolation would cost some at every call.
void ArkodeStepper::state_at(double time, double* x) {
    const bool at_end = time == to_.time || to_.time <= from_.time;
    if (at_end || time == from_.time) {
        std::copy_n((at_end ? to_ : from_).x.data(), weights_.size(), x);
        return;
    }
    complete_ends();
    interpolate((time - from_.time) / (to_.time - from_.time), x);
}

// @param s  0 ... 1
void ArkodeStepper::interpolate(double s, double* x) const {
    Eigen::Map<Vector> out(x, weights_.size());
    const Eigen::Index m = equations_.size();
    const double h = to_.time - from_.time;
    for (Eigen::Index i = 0; i < m; ++i) {
        // p(s) = p0 + v0 s + a0 s^2/2 + s^3 (c + s (d + s e)), in units of the step
        const double v0 = h * from_.x(m + i), a0 = h * h * from_.xdd(i), v1 = h * to_.x(m + i), a1 = h * h * to_.xdd(i);
        const double rise = to_.x(i) - from_.x(i) - v0 - a0 / 2, rate = v1 - v0 - a0, bend = a1 - a0;
        const double c = 10 * rise - 4 * rate + bend / 2, d = -15 * rise + 7 * rate - bend,
                     e = 6 * rise - 3 * rate + bend / 2;
        out(i) = from_.x(i) + s * (v0 + s * (a0 / 2 + s * (c + s * (d + s * e))));
        out(m + i) = (v0 + s * (a0 + s * (3 * c + s * (4 * d + s * 5 * e)))) / h;
    }
    const double u = 1 - s;
    for (Eigen::Index i = 0; i < equations_.states(); ++i) {
        const double r0 = h * from_.xdd(m + i), r1 = h * to_.xdd(m + i);
        out(2 * m + i) = u * u * (1 + 2 * s) * from_.x(2 * m + i) + s * s * (1 + 2 * u) * to_.x(2 * m + i) +
                         s * u * (u * r0 - s * r1) + s * s * u * u * quartic_(i);
    }
}

bool ArkodeStepper::local_errors() {
    return ARKStepGetEstLocalErrors(arkode_.get(), errors()) == 0 &&
           ARKStepGetErrWeights(arkode_.get(), error_weights()) == 0;
}

IntegrationStatistics ArkodeStepper::since_start() const {
    IntegrationStatistics out;
    void* ark = arkode_.get();
    long implicit_evaluations = 0;
    ARKStepGetNumSteps(ark, &out.steps);
    ARKStepGetNumErrTestFails(ark, &out.rejected);
    ARKStepGetNumStepSolveFails(ark, &out.not_converged);
    ARKStepGetNumRhsEvals(ark, &out.evaluations, &implicit_evaluations);
    out.evaluations += implicit_evaluations;
    ARKStepGetLastStep(ark, &out.last_step);
    out.order = 5;
    if (newton_) {
        out.iterations = newton_->solutions;
        out.jacobians = newton_->jacobians;
        out.factorisations = newton_->factorisations;
    }
    return out;
}

}  // namespace

std::unique_ptr<Stepper> make_arkode_stepper(EquationsOfMotion& equations, const IntegrationOptions& options) {
    return std::make_unique<ArkodeStepper>(equations, options);
}

}  // namespace cardan::solvers
