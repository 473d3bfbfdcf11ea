#include "solvers/time/detail/stepper_sundials.hpp"

#include <algorithm>
#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

namespace cardan::solvers {

namespace {

void free_cvode(void* memory) {
    CVodeFree(&memory);
}

class CvodeStepper : public SundialsStepper {
public:
    CvodeStepper(EquationsOfMotion& equations, const IntegrationOptions& options);

    double time() const override { return time_; }
    void state_at(double time, double* x) override;

private:
    void do_start(double time, const double* x, double stop) override;
    bool do_step(double horizon) override;
    static int linear_system(realtype t, N_Vector x, N_Vector, SUNMatrix, booleantype old_will_do, booleantype* is_new,
                             realtype c, void* user, N_Vector, N_Vector, N_Vector) {
        return static_cast<CvodeStepper*>(static_cast<SundialsStepper*>(user))
            ->form_matrix(t, x, c, old_will_do, is_new);
    }
    static int correct(realtype t, N_Vector x, N_Vector correction, realtype, N_Vector, void* user);
    void set_up(const IntegrationOptions& options);
    IntegrationStatistics since_start() const override;
    bool local_errors() override;

    SundialsNonlinear fixed_point_;
    std::unique_ptr<void, SundialsDeleter<free_cvode>> cvode_;
};

CvodeStepper::CvodeStepper(EquationsOfMotion& equations, const IntegrationOptions& options)
    : SundialsStepper("CVODE", equations, options, 0) {
    if (options.fixed_step > 0)
        throw InputError("time integration", "fixed step [s] with bdf or adams", options.fixed_step,
                         "0; dirk, erk and generalised_alpha have fixed steps");
    set_up(options);
}

void CvodeStepper::set_up(const IntegrationOptions& options) {
    const bool bdf = options.method == Method::bdf;
    cvode_.reset(CVodeCreate(bdf ? CV_BDF : CV_ADAMS, context()));
    void* cv = cvode_.get();
    SundialsStepper* user = this;
    bool ok = cv && CVodeSetErrHandlerFn(cv, sundials_quiet, nullptr) == 0 && CVodeInit(cv, rates, 0, vector()) == 0 &&
              CVodeSetUserData(cv, user) == 0 && CVodeWFtolerances(cv, weights) == 0 &&
              CVodeSetMaxHnilWarns(cv, -1) == 0 && CVodeSetMaxStep(cv, options.max_step) == 0 &&
              (options.max_order == 0 || CVodeSetMaxOrd(cv, options.max_order) == 0);
    if (bdf) {
        use_newton();
        // From order 3 on the method is unstable for weakly damped modes in a range of steps: the library watches for
        // that and lowers the order where it sees it.
        ok = ok && CVodeSetLinearSolver(cv, newton_->solver(), newton_->matrix()) == 0 &&
             CVodeSetLinSysFn(cv, linear_system) == 0 && CVodeSetStabLimDet(cv, SUNTRUE) == 0;
    } else {
        fixed_point_.reset(SUNNonlinSol_FixedPoint(vector(), 0, context()));
        ok = ok && CVodeSetNonlinearSolver(cv, fixed_point_.get()) == 0;
    }
    if (equations_.loops()) ok = ok && CVodeSetProjFn(cv, correct) == 0 && CVodeSetProjErrEst(cv, SUNFALSE) == 0;
    if (!ok) throw NumericalError("SUNDIALS: CVODE could not be set up");
}

int CvodeStepper::correct(realtype t, N_Vector x, N_Vector correction, realtype, N_Vector, void* user) {
    N_VScale(1, x, correction);
    const int flag = project(t, correction, user);
    N_VLinearSum(1, correction, -1, x, correction);
    return flag;
}

void CvodeStepper::do_start(double time, const double* x, double stop) {
    begin(time, x, stop);
    void* cv = cvode_.get();
    bool ok = CVodeReInit(cv, time, vector()) == 0 && CVodeSetInitStep(cv, std::min(first_step_, stop - time)) == 0;
    if (std::isfinite(stop)) ok = ok && CVodeSetStopTime(cv, stop) == 0;
    if (!ok) throw NumericalError("SUNDIALS: CVODE could not be started");
}

bool CvodeStepper::do_step(double horizon) {
    equations_.clear_problem();
    const double from = time_;
    const int flag = CVode(cvode_.get(), towards(horizon), vector(), &time_, CV_ONE_STEP);
    rethrow();
    if (flag >= 0 && (time_ == stop_ || !stands_still(from, time_))) return true;
    failure_ = explain(flag, "jumps of forces (give their times as breaks) or a motion that ends in infinity");
    return false;
}

void CvodeStepper::state_at(double time, double* x) {
    // At the end, or where nothing has been stepped yet, there is nothing to interpolate.
    if (time != time_ && CVodeGetDky(cvode_.get(), time, 0, errors()) != 0)
        throw NoState(text("time integration: no state at ", time, " s, outside of the last step"));
    const double* from = time == time_ ? data() : N_VGetArrayPointer(errors());
    std::copy(from, from + weights_.size(), x);
}

bool CvodeStepper::local_errors() {
    return CVodeGetEstLocalErrors(cvode_.get(), errors()) == 0 &&
           CVodeGetErrWeights(cvode_.get(), error_weights()) == 0;
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

}  // namespace

std::unique_ptr<Stepper> make_cvode_stepper(EquationsOfMotion& equations, const IntegrationOptions& options) {
    return std::make_unique<CvodeStepper>(equations, options);
}

}  // namespace cardan::solvers
