#include "solvers/newton_matrix.hpp"
#include "solvers/stepper.hpp"
#include "solvers/sundials_memory.hpp"

#include <algorithm>
#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#include <exception>
#include <limits>
#include <optional>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#include <utility>

namespace cardan::solvers {

namespace {

void free_cvode(void* memory) {
    CVodeFree(&memory);
}

const char* reason(int flag) {
    switch (flag) {
        case CV_TOO_MUCH_ACC:
            return "the tolerances ask for more than double precision has";
        case CV_ERR_FAILURE:
            return "the error test failed again and again";
        case CV_CONV_FAILURE:
            return "the iteration did not converge, not even with the smallest step";
        case CV_LSETUP_FAIL:
        case CV_LSOLVE_FAIL:
            return "the matrix of the iteration could not be formed";
        case CV_RHSFUNC_FAIL:
        case CV_FIRST_RHSFUNC_ERR:
        case CV_REPTD_RHSFUNC_ERR:
        case CV_UNREC_RHSFUNC_ERR:
            return "the accelerations could not be computed";
        default:
            return "CVODE reported an error";
    }
}

class CvodeStepper : public Stepper {
public:
    CvodeStepper(EquationsOfMotion& equations, const IntegrationOptions& options);

    void start(double time, const double* x, double stop) override;
    bool step(double horizon) override;
    double time() const override { return time_; }
    void state_at(double time, double* x) override;
    IntegrationStatistics statistics() const override;

private:
    static int rates(realtype t, N_Vector x, N_Vector xd, void* user);
    static int weights(N_Vector x, N_Vector w, void* user);
    static int linear_system(realtype t, N_Vector x, N_Vector xd, SUNMatrix, booleantype old_will_do,
                             booleantype* is_new, realtype c, void* user, N_Vector, N_Vector, N_Vector);
    void set_up(const IntegrationOptions& options, double time);
    IntegrationStatistics since_start() const;
    std::string explain(std::string_view why);

    EquationsOfMotion& equations_;
    ErrorWeights weights_;
    Method method_;
    double time_ = 0, stop_ = 0, first_step_;
    std::exception_ptr thrown_;
    IntegrationStatistics before_;  ///< up to the last start
    // In this order: CVODE goes before what it uses, the context last.
    SundialsContext context_;
    SundialsVector x_, errors_, error_weights_;
    std::optional<NewtonMatrix> newton_;
    SundialsNonlinear fixed_point_;
    std::unique_ptr<void, SundialsDeleter<free_cvode>> cvode_;
};

CvodeStepper::CvodeStepper(EquationsOfMotion& equations, const IntegrationOptions& options)
    : equations_(equations),
      weights_(equations, options.tolerances),
      method_(options.method),
      first_step_(options.first_step),
      context_(make_sundials_context()) {
    if (options.fixed_step > 0)
        throw InputError("time integration", "fixed step [s] with bdf or adams", options.fixed_step,
                         "0; dirk, erk and generalised_alpha have fixed steps");
    for (SundialsVector* v : {&x_, &errors_, &error_weights_}) {
        v->reset(N_VNew_Serial(weights_.size(), context_.get()));
        N_VConst(0, v->get());
    }
    set_up(options, 0);
}

void CvodeStepper::set_up(const IntegrationOptions& options, double time) {
    const bool bdf = method_ == Method::bdf;
    cvode_.reset(CVodeCreate(bdf ? CV_BDF : CV_ADAMS, context_.get()));
    void* cv = cvode_.get();
    bool ok = CVodeSetErrHandlerFn(cv, sundials_quiet, nullptr) == 0 && CVodeInit(cv, rates, time, x_.get()) == 0 &&
              CVodeSetUserData(cv, this) == 0 && CVodeWFtolerances(cv, weights) == 0 &&
              CVodeSetMaxHnilWarns(cv, -1) == 0 && CVodeSetMaxStep(cv, options.max_step) == 0 &&
              (options.max_order == 0 || CVodeSetMaxOrd(cv, options.max_order) == 0);
    if (bdf) {
        newton_.emplace(equations_, context_.get());
        ok = ok && CVodeSetLinearSolver(cv, newton_->solver(), newton_->matrix()) == 0 &&
             CVodeSetLinSysFn(cv, linear_system) == 0;
    } else {
        fixed_point_.reset(SUNNonlinSol_FixedPoint(x_.get(), 0, context_.get()));
        ok = ok && CVodeSetNonlinearSolver(cv, fixed_point_.get()) == 0;
    }
    if (!ok) throw NumericalError("SUNDIALS: CVODE could not be set up");
}

// Exceptions must not cross CVODE: kept and rethrown outside. What only concerns a trial state may be tried again with
// a shorter step.
int CvodeStepper::rates(realtype t, N_Vector x, N_Vector xd, void* user) {
    auto& self = *static_cast<CvodeStepper*>(user);
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

int CvodeStepper::weights(N_Vector x, N_Vector w, void* user) {
    static_cast<CvodeStepper*>(user)->weights_.set(N_VGetArrayPointer(x), N_VGetArrayPointer(w));
    return 0;
}

int CvodeStepper::linear_system(realtype t, N_Vector x, N_Vector, SUNMatrix, booleantype old_will_do,
                                booleantype* is_new, realtype c, void* user, N_Vector, N_Vector, N_Vector) {
    auto& self = *static_cast<CvodeStepper*>(user);
    *is_new = old_will_do ? SUNFALSE : SUNTRUE;
    try {
        return self.newton_->form(t, N_VGetArrayPointer(x), c, !old_will_do) ? 0 : 1;
    } catch (...) {
        self.thrown_ = std::current_exception();
        return -1;
    }
}

void CvodeStepper::start(double time, const double* x, double stop) {
    before_ = statistics();
    time_ = time;
    stop_ = stop;
    std::copy(x, x + weights_.size(), N_VGetArrayPointer(x_.get()));
    if (newton_) newton_->jacobians = newton_->factorisations = 0;
    void* cv = cvode_.get();
    bool ok = CVodeReInit(cv, time, x_.get()) == 0 && CVodeSetInitStep(cv, std::min(first_step_, stop - time)) == 0;
    if (std::isfinite(stop)) ok = ok && CVodeSetStopTime(cv, stop) == 0;
    if (!ok) throw NumericalError("SUNDIALS: CVODE could not be started");
}

bool CvodeStepper::step(double horizon) {
    double towards = std::min(horizon, stop_);
    if (!std::isfinite(towards)) towards = time_ + 1;
    equations_.forget_problem();
    const double from = time_;
    const int flag = CVode(cvode_.get(), towards, x_.get(), &time_, CV_ONE_STEP);
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
    if (flag >= 0 && (time_ == stop_ || !stands_still(from, time_))) return true;
    failure_ = explain(flag >= 0 ? standstill : reason(flag));
    return false;
}

void CvodeStepper::state_at(double time, double* x) {
    // At the end, or where nothing has been stepped yet, there is nothing to interpolate.
    if (time != time_ && CVodeGetDky(cvode_.get(), time, 0, errors_.get()) != 0)
        throw NumericalError(text("time integration: no state at ", time, " s, outside of the last step"));
    const double* from = N_VGetArrayPointer(time == time_ ? x_.get() : errors_.get());
    std::copy(from, from + weights_.size(), x);
}

std::string CvodeStepper::explain(std::string_view why) {
    void* cv = cvode_.get();
    const IntegrationStatistics now = since_start();
    std::string message =
        text("no step possible at ", time_, " s: ", why, " (order ", now.order, ", last step ", now.last_step, " s)");
    if (!equations_.problem().empty()) message += text("; ", equations_.problem());
    if (CVodeGetEstLocalErrors(cv, errors_.get()) == 0 && CVodeGetErrWeights(cv, error_weights_.get()) == 0) {
        const LimitingEntry worst = limiting_entry(N_VGetArrayPointer(errors_.get()),
                                                   N_VGetArrayPointer(error_weights_.get()), 2 * equations_.size());
        if (worst.entry >= 0)
            message += text("; the largest local error, ", worst.error, " times the allowed one, has the ",
                            equations_.name_of(worst.entry));
    }
    return message + "; look for jumps of forces (give their times as breaks) or a motion that ends in infinity";
}

IntegrationStatistics CvodeStepper::since_start() const {
    IntegrationStatistics out;
    void* cv = cvode_.get();
    CVodeGetNumSteps(cv, &out.steps);
    CVodeGetNumErrTestFails(cv, &out.rejected);
    CVodeGetNumStepSolveFails(cv, &out.not_converged);
    CVodeGetNumRhsEvals(cv, &out.evaluations);
    CVodeGetNumNonlinSolvIters(cv, &out.iterations);
    CVodeGetLastOrder(cv, &out.order);
    CVodeGetLastStep(cv, &out.last_step);
    if (newton_) {
        out.jacobians = newton_->jacobians;
        out.factorisations = newton_->factorisations;
    }
    return out;
}

IntegrationStatistics CvodeStepper::statistics() const {
    return sum(before_, since_start());
}

}  // namespace

std::unique_ptr<Stepper> make_cvode_stepper(EquationsOfMotion& equations, const IntegrationOptions& options) {
    return std::make_unique<CvodeStepper>(equations, options);
}

}  // namespace cardan::solvers
