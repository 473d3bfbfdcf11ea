#include "solvers/newton_matrix.hpp"
#include "solvers/stepper.hpp"
#include "solvers/sundials_memory.hpp"

#include <algorithm>
#include <arkode/arkode_arkstep.h>
#include <exception>
#include <optional>
#include <utility>

namespace cardan::solvers {

namespace {

void free_arkode(void* memory) {
    ARKStepFree(&memory);
}

const char* reason(int flag) {
    switch (flag) {
        case ARK_TOO_MUCH_ACC:
            return "the tolerances ask for more than double precision has";
        case ARK_ERR_FAILURE:
            return "the error test failed again and again";
        case ARK_CONV_FAILURE:
            return "the iteration did not converge, not even with the smallest step";
        case ARK_LSETUP_FAIL:
        case ARK_LSOLVE_FAIL:
            return "the matrix of the iteration could not be formed";
        case ARK_RHSFUNC_FAIL:
        case ARK_FIRST_RHSFUNC_ERR:
        case ARK_REPTD_RHSFUNC_ERR:
        case ARK_UNREC_RHSFUNC_ERR:
            return "the accelerations could not be computed";
        default:
            return "ARKODE reported an error";
    }
}

class ArkodeStepper : public Stepper {
public:
    ArkodeStepper(EquationsOfMotion& equations, const IntegrationOptions& options);

    void start(double time, const double* x, double stop) override;
    bool step(double horizon) override;
    double time() const override { return to_.time; }
    void state_at(double time, double* x) override;
    IntegrationStatistics statistics() const override { return sum(before_, since_start()); }

private:
    static int rates(realtype t, N_Vector x, N_Vector xd, void* user);
    static int weights(N_Vector x, N_Vector w, void* user);
    static int linear_system(realtype t, N_Vector x, N_Vector xd, SUNMatrix, SUNMatrix, booleantype old_will_do,
                             booleantype* is_new, realtype c, void* user, N_Vector, N_Vector, N_Vector);
    void set_up(const IntegrationOptions& options);
    void complete_ends();
    IntegrationStatistics since_start() const;
    std::string explain(std::string_view why);
    ARKRhsFn explicit_rates() const { return implicit_ ? nullptr : rates; }
    ARKRhsFn implicit_rates() const { return implicit_ ? rates : nullptr; }

    EquationsOfMotion& equations_;
    ErrorWeights weights_;
    bool implicit_;
    double stop_ = 0, first_step_, fixed_step_;
    struct End {
        double time = 0;
        Vector x, qdd;
        bool known = false;  ///< the accelerations
    };
    End from_, to_;
    std::exception_ptr thrown_;
    IntegrationStatistics before_;  ///< up to the last start
    // In this order: ARKODE goes before what it uses, the context last.
    SundialsContext context_;
    SundialsVector x_, errors_, error_weights_;
    std::optional<NewtonMatrix> newton_;
    std::unique_ptr<void, SundialsDeleter<free_arkode>> arkode_;
};

ArkodeStepper::ArkodeStepper(EquationsOfMotion& equations, const IntegrationOptions& options)
    : equations_(equations),
      weights_(equations, options.tolerances),
      implicit_(options.method == Method::dirk),
      first_step_(options.first_step),
      fixed_step_(options.fixed_step),
      context_(make_sundials_context()) {
    for (SundialsVector* v : {&x_, &errors_, &error_weights_}) {
        v->reset(N_VNew_Serial(weights_.size(), context_.get()));
        N_VConst(0, v->get());
    }
    for (End* end : {&from_, &to_}) {
        end->x.setZero(weights_.size());
        end->qdd.setZero(equations.size());
    }
    set_up(options);
}

void ArkodeStepper::set_up(const IntegrationOptions& options) {
    arkode_.reset(ARKStepCreate(explicit_rates(), implicit_rates(), 0, x_.get(), context_.get()));
    void* ark = arkode_.get();
    const auto implicit_table = implicit_ ? ARKODE_SDIRK_5_3_4 : ARKODE_DIRK_NONE;
    const auto explicit_table = implicit_ ? ARKODE_ERK_NONE : ARKODE_DORMAND_PRINCE_7_4_5;
    bool ok = ark && ARKStepSetErrHandlerFn(ark, sundials_quiet, nullptr) == 0 && ARKStepSetUserData(ark, this) == 0 &&
              ARKStepSetTableNum(ark, implicit_table, explicit_table) == 0 && ARKStepWFtolerances(ark, weights) == 0 &&
              ARKStepSetMaxHnilWarns(ark, -1) == 0 && ARKStepSetMaxStep(ark, options.max_step) == 0;
    if (fixed_step_ > 0) ok = ok && ARKStepSetFixedStep(ark, fixed_step_) == 0;
    if (implicit_) {
        newton_.emplace(equations_, context_.get());
        ok = ok && ARKStepSetLinearSolver(ark, newton_->solver(), newton_->matrix()) == 0 &&
             ARKStepSetLinSysFn(ark, linear_system) == 0;
    }
    // What does not converge cannot be tried again with a shorter step then: fresh matrices, more patience.
    if (fixed_step_ > 0 && implicit_)
        ok = ok && ARKStepSetMaxNonlinIters(ark, 12) == 0 && ARKStepSetLSetupFrequency(ark, 1) == 0 &&
             ARKStepSetJacEvalFrequency(ark, 1) == 0;
    if (!ok) throw NumericalError("SUNDIALS: ARKODE could not be set up");
}

// Exceptions must not cross ARKODE: kept and rethrown outside. What only concerns a trial state may be tried again with
// a shorter step.
int ArkodeStepper::rates(realtype t, N_Vector x, N_Vector xd, void* user) {
    auto& self = *static_cast<ArkodeStepper*>(user);
    const Eigen::Index m = self.equations_.size();
    const double* in = N_VGetArrayPointer(x);
    double* out = N_VGetArrayPointer(xd);
    try {
        if (!self.equations_.accelerations(t, in, out + m)) return 1;
    } catch (...) {
        self.thrown_ = std::current_exception();
        return -1;
    }
    std::copy(in + m, in + 2 * m, out);
    return 0;
}

int ArkodeStepper::weights(N_Vector x, N_Vector w, void* user) {
    static_cast<ArkodeStepper*>(user)->weights_.set(N_VGetArrayPointer(x), N_VGetArrayPointer(w));
    return 0;
}

int ArkodeStepper::linear_system(realtype t, N_Vector x, N_Vector, SUNMatrix, SUNMatrix, booleantype old_will_do,
                                 booleantype* is_new, realtype c, void* user, N_Vector, N_Vector, N_Vector) {
    auto& self = *static_cast<ArkodeStepper*>(user);
    *is_new = old_will_do ? SUNFALSE : SUNTRUE;
    try {
        return self.newton_->form(t, N_VGetArrayPointer(x), c, !old_will_do) ? 0 : 1;
    } catch (...) {
        self.thrown_ = std::current_exception();
        return -1;
    }
}

void ArkodeStepper::start(double time, const double* x, double stop) {
    before_ = statistics();
    to_.time = from_.time = time;
    to_.known = false;
    stop_ = stop;
    std::copy(x, x + weights_.size(), to_.x.data());
    std::copy(x, x + weights_.size(), N_VGetArrayPointer(x_.get()));
    if (newton_) newton_->jacobians = newton_->factorisations = 0;
    void* ark = arkode_.get();
    bool ok = ARKStepReInit(ark, explicit_rates(), implicit_rates(), time, x_.get()) == 0;
    if (fixed_step_ == 0) ok = ok && ARKStepSetInitStep(ark, std::min(first_step_, stop - time)) == 0;
    if (std::isfinite(stop)) ok = ok && ARKStepSetStopTime(ark, stop) == 0;
    if (!ok) throw NumericalError("SUNDIALS: ARKODE could not be started");
}

bool ArkodeStepper::step(double horizon) {
    double towards = std::min(horizon, stop_), reached = to_.time;
    if (!std::isfinite(towards)) towards = to_.time + 1;
    equations_.forget_problem();
    const int flag = ARKStepEvolve(arkode_.get(), towards, x_.get(), &reached, ARK_ONE_STEP);
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
    if (flag < 0 || (reached != stop_ && stands_still(to_.time, reached))) {
        failure_ = explain(flag < 0 ? reason(flag) : standstill);
        return false;
    }
    std::swap(from_, to_);
    to_.time = reached;
    to_.known = false;
    std::copy(N_VGetArrayPointer(x_.get()), N_VGetArrayPointer(x_.get()) + weights_.size(), to_.x.data());
    return true;
}

// Both ends of the last step with their accelerations, evaluated where they are wanted for the first time.
void ArkodeStepper::complete_ends() {
    const auto evaluate = [&](double time, const Vector& x, Vector& qdd, bool& known) {
        if (!known && !equations_.accelerations(time, x.data(), qdd.data()))
            throw NumericalError(text("time integration: ", equations_.problem()));
        known = true;
    };
    evaluate(from_.time, from_.x, from_.qdd, from_.known);
    evaluate(to_.time, to_.x, to_.qdd, to_.known);
}

// Hermite's quintic through positions, rates and accelerations at both ends, and its derivative: of order 5 in the
// rates, one evaluation per step. ARKODE's own interpolation would cost some at every call.
void ArkodeStepper::state_at(double time, double* x) {
    Eigen::Map<Vector> out(x, weights_.size());
    if (time == to_.time || to_.time <= from_.time) {
        out = to_.x;
        return;
    }
    complete_ends();
    const Eigen::Index m = equations_.size();
    const double h = to_.time - from_.time, s = (time - from_.time) / h;
    for (Eigen::Index i = 0; i < m; ++i) {
        // p(s) = p0 + v0 s + a0 s^2/2 + s^3 (c + s (d + s e)), in units of the step
        const double v0 = h * from_.x(m + i), a0 = h * h * from_.qdd(i), v1 = h * to_.x(m + i), a1 = h * h * to_.qdd(i);
        const double rise = to_.x(i) - from_.x(i) - v0 - a0 / 2, rate = v1 - v0 - a0, bend = a1 - a0;
        const double c = 10 * rise - 4 * rate + bend / 2, d = -15 * rise + 7 * rate - bend,
                     e = 6 * rise - 3 * rate + bend / 2;
        out(i) = from_.x(i) + s * (v0 + s * (a0 / 2 + s * (c + s * (d + s * e))));
        out(m + i) = (v0 + s * (a0 + s * (3 * c + s * (4 * d + s * 5 * e)))) / h;
    }
}

std::string ArkodeStepper::explain(std::string_view why) {
    void* ark = arkode_.get();
    std::string message =
        text("no step possible at ", to_.time, " s: ", why, " (last step ", since_start().last_step, " s)");
    if (!equations_.problem().empty()) message += text("; ", equations_.problem());
    if (ARKStepGetEstLocalErrors(ark, errors_.get()) == 0 && ARKStepGetErrWeights(ark, error_weights_.get()) == 0) {
        const LimitingEntry worst = limiting_entry(N_VGetArrayPointer(errors_.get()),
                                                   N_VGetArrayPointer(error_weights_.get()), 2 * equations_.size());
        if (worst.entry >= 0)
            message += text("; the largest local error, ", worst.error, " times the allowed one, has the ",
                            equations_.name_of(worst.entry));
    }
    return message +
           "; look for jumps of forces (give their times as breaks), a step too long for the explicit method "
           "or a motion that ends in infinity";
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
    out.order = implicit_ ? 4 : 5;
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
