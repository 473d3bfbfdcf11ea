#include "solvers/time/detail/stepper_sundials.hpp"

#include <algorithm>
#include <arkode/arkode_arkstep.h>
#include <utility>

namespace cardan::solvers {

namespace {

void free_arkode(void* memory) {
    ARKStepFree(&memory);
}

class ArkodeStepper : public SundialsStepper {
public:
    ArkodeStepper(EquationsOfMotion& equations, const IntegrationOptions& options);

    double time() const override { return time_; }
    void state_at(double time, double* x) override;

private:
    void do_start(double time, const double* x, double stop) override { begin_at(time, x, stop, 0); }
    bool do_step(double horizon) override;
    void remember(double* memory) const override;
    void do_resume(double time, const double* x, double stop, const double* memory) override {
        begin_at(time, x, stop, memory[0]);
    }
    void begin_at(double time, const double* x, double stop, double next_step);
    static int linear_system(realtype t, N_Vector x, N_Vector, SUNMatrix, SUNMatrix, booleantype old_will_do,
                             booleantype* is_new, realtype c, void* user, N_Vector, N_Vector, N_Vector) {
        return static_cast<ArkodeStepper*>(static_cast<SundialsStepper*>(user))
            ->form_matrix(t, x, c, old_will_do, is_new);
    }
    void set_up(const IntegrationOptions& options);
    bool set_up_newton(void* ark);
    void complete_ends();
    void complete_states();
    void interpolate(double s, double* x) const;
    IntegrationStatistics since_start() const override;
    bool local_errors() override;
    ARKRhsFn explicit_rates() const { return implicit_ ? nullptr : rates; }
    ARKRhsFn implicit_rates() const { return implicit_ ? rates : nullptr; }

    bool implicit_;
    double fixed_step_;
    double resumed_with_ = 0;  ///< s, step that it goes on with; 0: it has gone on
    struct End {
        double time = 0;
        Vector x, xdd;
        bool known = false;  ///< the accelerations and rates of states
    };
    End from_, to_;
    Vector quartic_;                  ///< of the states' interpolation
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
              ARKStepSetPredictorMethod(ark, 1) == 0 && ARKStepSetInterpolantDegree(ark, 3) == 0;
    // With a fixed step a failed iteration cannot be retried with a shorter one: fresh matrices, more iterations.
    if (fixed_step_ > 0)
        ok = ok && ARKStepSetMaxNonlinIters(ark, 12) == 0 && ARKStepSetLSetupFrequency(ark, 1) == 0 &&
             ARKStepSetJacEvalFrequency(ark, 1) == 0;
    return ok;
}

// The length of the next step; the step control starts afresh with it, within the bounds of steps that are not the
// first.
void ArkodeStepper::remember(double* memory) const {
    memory[0] = fixed_step_ > 0 ? fixed_step_ : resumed_with_;
    if (memory[0] == 0 && ARKStepGetCurrentStep(arkode_.get(), memory) != 0)
        throw NumericalError("SUNDIALS: ARKODE does not know its step");
}

// @param next_step  0: a start, where the library looks for the first step itself
void ArkodeStepper::begin_at(double time, const double* x, double stop, double next_step) {
    constexpr double largest_growth = 20;  // of the library, but for a first step
    begin(time, x, stop);
    resumed_with_ = next_step;
    to_.time = from_.time = time;
    to_.known = false;
    std::copy(x, x + weights_.size(), to_.x.data());
    void* ark = arkode_.get();
    bool ok = ARKStepReInit(ark, explicit_rates(), implicit_rates(), time, vector()) == 0;
    if (fixed_step_ == 0)
        ok = ok && ARKStepSetMaxFirstGrowth(ark, next_step > 0 ? largest_growth : 0) == 0 &&
             ARKStepSetInitStep(ark, std::min(next_step > 0 ? next_step : first_step_, stop - time)) == 0;
    if (std::isfinite(stop)) ok = ok && ARKStepSetStopTime(ark, stop) == 0;
    if (!ok) throw NumericalError("SUNDIALS: ARKODE could not be started");
}

bool ArkodeStepper::do_step(double horizon) {
    equations_.clear_problem();
    const double from = time_;
    const int flag = ARKStepEvolve(arkode_.get(), towards(horizon), vector(), &time_, ARK_ONE_STEP);
    rethrow();
    if (flag < 0 || (time_ != stop_ && stands_still(from, time_))) {
        time_ = from;
        failure_ = explain(flag,
                           "jumps of forces (give their times as breaks), a step too long for the explicit method or a "
                           "motion that ends in infinity");
        return false;
    }
    resumed_with_ = 0;
    std::swap(from_, to_);
    to_.time = time_;
    to_.known = false;
    std::copy(data(), data() + weights_.size(), to_.x.data());
    return true;
}

// Both ends of the last step with their accelerations, evaluated where they are wanted for the first time.
void ArkodeStepper::complete_ends() {
    const auto evaluate = [&](double time, const Vector& x, Vector& xdd, bool& known) {
        if (!known && !equations_.accelerations(time, x.data(), xdd.data()))
            throw NoState(text("time integration: ", equations_.problem()));
        known = true;
    };
    const bool fresh = !to_.known;
    evaluate(from_.time, from_.x, from_.xdd, from_.known);
    evaluate(to_.time, to_.x, to_.xdd, to_.known);
    if (fresh && equations_.states() > 0) complete_states();
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
        ARKStepGetNumNonlinSolvIters(ark, &out.iterations);
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
