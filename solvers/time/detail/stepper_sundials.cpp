#include "solvers/time/detail/stepper_sundials.hpp"

#include "solvers/time/detail/sundials_vector.hpp"

#include <algorithm>
#include <arkode/arkode.h>
#include <cmath>
#include <cvode/cvode.h>
#include <utility>

namespace cardan::solvers {

SundialsStepper::SundialsStepper(const char* library, EquationsOfMotion& equations, const IntegrationOptions& options,
                                 int memory)
    : Stepper(equations.length(), memory),
      equations_(equations),
      weights_(equations, options.tolerances),
      first_step_(options.first_step),
      library_(library),
      context_(make_sundials_context()) {
    for (SundialsVector* v : {&x_, &errors_, &error_weights_})
        *v = make_sundials_vector(weights_.size(), context_.get());
}

int SundialsStepper::rates(realtype t, N_Vector x, N_Vector xd, void* user) {
    auto& self = *static_cast<SundialsStepper*>(user);
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

int SundialsStepper::weights(N_Vector x, N_Vector w, void* user) {
    static_cast<SundialsStepper*>(user)->weights_.set(N_VGetArrayPointer(x), N_VGetArrayPointer(w));
    return 0;
}

// Onto the constraints of loops.
int SundialsStepper::project(realtype t, N_Vector x, void* user) {
    auto& self = *static_cast<SundialsStepper*>(user);
    try {
        return self.equations_.project(t, N_VGetArrayPointer(x)) ? 0 : 1;
    } catch (...) {
        self.thrown_ = std::current_exception();
        return -1;
    }
}

int SundialsStepper::form_matrix(realtype t, N_Vector x, realtype c, booleantype old_will_do, booleantype* is_new) {
    *is_new = old_will_do ? SUNFALSE : SUNTRUE;
    try {
        return newton_->form(t, N_VGetArrayPointer(x), c, !old_will_do) ? 0 : 1;
    } catch (...) {
        thrown_ = std::current_exception();
        return -1;
    }
}

void SundialsStepper::rethrow() {
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

void SundialsStepper::begin(double time, const double* x, double stop) {
    before_ = statistics();
    time_ = time;
    stop_ = stop;
    std::copy(x, x + weights_.size(), data());
    if (newton_) newton_->jacobians = newton_->factorisations = newton_->solutions = 0;
}

double SundialsStepper::towards(double horizon) const {
    // One step is taken whatever this is, but the libraries refuse to start toward a time that is almost now.
    const double nearest = std::min(horizon, stop_), shortest = 1e-6 * std::abs(time_);
    return std::isfinite(nearest) && nearest - time_ > shortest ? nearest : time_ + 1;
}

// The two libraries number their reasons alike.
static_assert(CV_TOO_MUCH_ACC == ARK_TOO_MUCH_ACC && CV_ERR_FAILURE == ARK_ERR_FAILURE &&
              CV_CONV_FAILURE == ARK_CONV_FAILURE && CV_LSETUP_FAIL == ARK_LSETUP_FAIL &&
              CV_LSOLVE_FAIL == ARK_LSOLVE_FAIL && CV_RHSFUNC_FAIL == ARK_RHSFUNC_FAIL &&
              CV_FIRST_RHSFUNC_ERR == ARK_FIRST_RHSFUNC_ERR && CV_REPTD_RHSFUNC_ERR == ARK_REPTD_RHSFUNC_ERR &&
              CV_UNREC_RHSFUNC_ERR == ARK_UNREC_RHSFUNC_ERR);

std::string SundialsStepper::reason(int flag) const {
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
            return text(library_, " reported an error (", flag, ")");
    }
}

std::string SundialsStepper::explain(int flag, std::string_view advice) {
    const IntegrationStatistics now = since_start();
    std::string message = text("no step possible at ", time_, " s: ", flag < 0 ? reason(flag) : std::string(standstill),
                               " (order ", now.order, ", last step ", now.last_step, " s)");
    if (!equations_.problem().empty()) message += text("; ", equations_.problem());
    if (local_errors()) {
        const LimitingEntry worst = limiting_entry(N_VGetArrayPointer(errors_.get()),
                                                   N_VGetArrayPointer(error_weights_.get()), equations_.length());
        if (worst.entry >= 0 && worst.error > informative)
            message += text("; the largest local error, ", worst.error, " times the allowed one, has the ",
                            equations_.name_of(worst.entry));
    }
    return text(message, "; look for ", advice);
}

}  // namespace cardan::solvers
