#include "solvers/steady_state.hpp"

#include "mbs/derivatives.hpp"
#include "mbs/error.hpp"

#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <exception>
#include <memory>

namespace cardan::solvers {

namespace {

template <auto Free>
struct Deleter {
    template <class T>
    void operator()(T* p) const {
        Free(p);
    }
};
void free_linear_solver(SUNLinearSolver s) {
    SUNLinSolFree(s);
}
void free_kinsol(void* memory) {
    KINFree(&memory);
}
void free_context(SUNContext c) {
    SUNContext_Free(&c);
}

using ContextPtr = std::unique_ptr<std::remove_pointer_t<SUNContext>, Deleter<free_context>>;
using VectorPtr = std::unique_ptr<std::remove_pointer_t<N_Vector>, Deleter<N_VDestroy>>;
using MatrixPtr = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, Deleter<SUNMatDestroy>>;
using SolverPtr = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, Deleter<free_linear_solver>>;
using KinsolPtr = std::unique_ptr<void, Deleter<free_kinsol>>;

// Residual and Jacobian on the unknowns (free coordinates without the spin).
class Residual {
public:
    Residual(const System& system, int spin, const SteadyOptions& options) : system_(system), workspace_(system.model) {
        const int n = system.model.size();
        for (int i : system.model.coordinates().free())
            if (i != spin) unknowns.push_back(i);
        at.q = options.initial.size() > 0 ? options.initial : Vector::Zero(n);
        at.qd.setZero(n);
        at.qdd.setZero(n);
        if (spin >= 0) {
            at.q(spin) = options.azimuth;
            at.qd(spin) = options.rotor_speed;
        }
        tau_.setZero(n);
        Q_.setZero(n);
        by_q_.setZero(n, n);
        by_qd_.setZero(n, n);
    }

    void set(const double* x) {
        for (std::size_t i = 0; i < unknowns.size(); ++i) at.q(unknowns[i]) = x[i];
    }
    void evaluate(double* r) {
        const Kinematics kin = kinematics(system_.model, at.q, workspace_);
        inverse_dynamics<double>(kin, at.qd, at.qdd, tau_);
        system_.forces.generalised_forces(kin, at.time, at.q, at.qd, Q_);
        for (std::size_t i = 0; i < unknowns.size(); ++i) r[i] = tau_(unknowns[i]) - Q_(unknowns[i]);
    }
    Matrix jacobian() {
        const Kinematics kin = kinematics(system_.model, at.q, workspace_);
        inverse_dynamics_derivatives<double>(kin, at.qd, at.qdd, by_q_, by_qd_);
        system_.forces.derivatives(kin, at.time, at.q, at.qd, forces_);
        by_q_ += forces_.elastic + forces_.gravity + forces_.loads;
        return by_q_(unknowns, unknowns);
    }
    // Of the springs alone, at the place of the last call of jacobian().
    Vector elastic_diagonal() const { return Matrix(forces_.elastic(unknowns, unknowns)).diagonal(); }

    std::vector<int> unknowns;
    OperatingPoint at;
    std::exception_ptr thrown;

private:
    const System& system_;
    Workspace workspace_;
    Vector tau_, Q_;
    Matrix by_q_, by_qd_;
    ForceDerivatives forces_;
};

// Exceptions must not cross KINSOL: kept and rethrown outside.
template <class F>
int guarded(void* user, F f) {
    auto* residual = static_cast<Residual*>(user);
    try {
        f(*residual);
        return 0;
    } catch (...) {
        residual->thrown = std::current_exception();
        return -1;
    }
}

int residual_callback(N_Vector x, N_Vector r, void* user) {
    return guarded(user, [&](Residual& residual) {
        residual.set(N_VGetArrayPointer(x));
        residual.evaluate(N_VGetArrayPointer(r));
    });
}

int jacobian_callback(N_Vector x, N_Vector, SUNMatrix J, void* user, N_Vector, N_Vector) {
    return guarded(user, [&](Residual& residual) {
        residual.set(N_VGetArrayPointer(x));
        const Matrix exact = residual.jacobian();
        std::copy(exact.data(), exact.data() + exact.size(), SUNDenseMatrix_Data(J));
    });
}

void quiet(int, const char*, const char*, char*, void*) {}

const char* reason(int flag) {
    switch (flag) {
        case KIN_LINESEARCH_NONCONV:
            return "the line search found no point with a smaller residual";
        case KIN_MAXITER_REACHED:
            return "the limit of iterations was reached";
        case KIN_MXNEWT_5X_EXCEEDED:
            return "five steps in a row were as long as the allowed step";
        case KIN_LINESEARCH_BCFAIL:
            return "the line search could not reduce the residual enough";
        case KIN_LSETUP_FAIL:
        case KIN_LSOLVE_FAIL:
        case KIN_LINSOLV_NO_RECOVERY:
            return "the stiffness matrix is singular (a mechanism, or buckling)";
        case KIN_SYSFUNC_FAIL:
        case KIN_FIRST_SYSFUNC_ERR:
            return "the residual could not be evaluated";
        default:
            return "KINSOL reported an error";
    }
}

void check_constant(Residual& residual, int spin, const SteadyOptions& options, const Vector& scale) {
    Vector r(scale.size());
    // An angle that is no multiple of the spacing of any usual number of blades.
    for (double turn : {1.0, 2.5}) {
        residual.at.q(spin) = options.azimuth + turn;
        residual.evaluate(r.data());
        const double largest = r.cwiseProduct(scale).cwiseAbs().maxCoeff();
        if (!(largest < 1e-7))
            throw NumericalError(
                text("no constant steady state at ", options.rotor_speed, " rad/s: with the rotor turned by ", turn,
                     " rad the forces leave a residual of ", largest,
                     " (residual over stiffness, rad or m; allowed 1e-7). Gravity in rotation, an unbalanced or a "
                     "two-bladed rotor have a periodic steady state, which is not available yet; leave gravity out or "
                     "stop the rotor"));
    }
    residual.at.q(spin) = options.azimuth;
}

}  // namespace

SteadyState steady_state(const System& system, int spin, const SteadyOptions& options) {
    if (!std::isfinite(options.rotor_speed) || !std::isfinite(options.azimuth))
        throw InputError("steady state", "rotor speed [rad/s], azimuth [rad]",
                         text(options.rotor_speed, ", ", options.azimuth), "finite");
    if (spin < -1 || spin >= system.model.size())
        throw InputError("steady state", "index of the spin coordinate", spin,
                         text("-1 (none) ... ", system.model.size() - 1));
    if (spin < 0 && options.rotor_speed != 0)
        throw InputError("steady state", "rotor speed [rad/s]", options.rotor_speed, "0 for a system without rotor");
    if (options.initial.size() != 0 && options.initial.size() != system.model.size())
        throw InputError("steady state", "size of the starting point", options.initial.size(),
                         text(system.model.size(), ", one per coordinate, or empty"));
    Residual residual(system, spin, options);
    SteadyState result;
    const auto n = static_cast<sunindextype>(residual.unknowns.size());
    if (n == 0) {
        result = {true, residual.at, 0, 0, {}};
        return result;
    }

    SUNContext raw_context = nullptr;
    if (SUNContext_Create(nullptr, &raw_context) != 0) throw NumericalError("SUNDIALS: no context");
    const ContextPtr context(raw_context);
    const VectorPtr x(N_VNew_Serial(n, raw_context)), x_scale(N_VNew_Serial(n, raw_context)),
        f_scale(N_VNew_Serial(n, raw_context));
    const MatrixPtr J(SUNDenseMatrix(n, n, raw_context));
    const SolverPtr linear(SUNLinSol_Dense(x.get(), J.get(), raw_context));
    const KinsolPtr kinsol(KINCreate(raw_context));

    // Residuals are measured by the stiffness on the diagonal, so that they read as rad or m; by a millionth of the
    // springs at least, for at a critical load they and the loads cancel.
    const Matrix J0 = residual.jacobian();
    const Vector springs = residual.elastic_diagonal().cwiseAbs();
    const double stiffest = std::max({J0.diagonal().cwiseAbs().maxCoeff(), springs.maxCoeff(), 1e-280});
    Vector scale(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        scale(i) = 1 / std::max({std::abs(J0(i, i)), 1e-6 * springs(i), 1e-12 * stiffest});
        N_VGetArrayPointer(x.get())[i] = residual.at.q(residual.unknowns[static_cast<std::size_t>(i)]);
        N_VGetArrayPointer(f_scale.get())[i] = scale(i);
    }
    N_VConst(1.0, x_scale.get());

    void* kin = kinsol.get();
    bool ok = KINInit(kin, residual_callback, x.get()) == 0 && KINSetUserData(kin, &residual) == 0 &&
              KINSetErrHandlerFn(kin, quiet, nullptr) == 0 && KINSetLinearSolver(kin, linear.get(), J.get()) == 0 &&
              KINSetJacFn(kin, jacobian_callback) == 0 && KINSetMaxSetupCalls(kin, 1) == 0 &&
              KINSetNumMaxIters(kin, options.iterations) == 0 && KINSetFuncNormTol(kin, options.tolerance) == 0 &&
              KINSetScaledStepTol(kin, 1e-14) == 0 && KINSetMaxNewtonStep(kin, 10.0) == 0;
    if (!ok) throw NumericalError("SUNDIALS: KINSOL could not be set up");
    const int flag = KINSol(kin, x.get(), KIN_LINESEARCH, x_scale.get(), f_scale.get());
    if (residual.thrown) std::rethrow_exception(residual.thrown);

    long iterations = 0;
    KINGetNumNonlinSolvIters(kin, &iterations);
    Vector r(n);
    residual.set(N_VGetArrayPointer(x.get()));
    residual.evaluate(r.data());
    result.residual = r.cwiseProduct(scale).cwiseAbs().maxCoeff();
    result.iterations = static_cast<int>(iterations);
    // A step too small to improve on is as good as the arithmetic allows if the residual is small as well.
    result.converged = flag >= 0 && result.residual < std::max(1e-8, options.tolerance);
    if (!result.converged)
        result.message = text("steady state not found after ", iterations, " iterations (residual over stiffness ",
                              result.residual, ", wanted ", options.tolerance, "): ", reason(flag),
                              "; start from a neighbouring state or approach the load in steps");
    if (result.converged && spin >= 0 && options.rotor_speed != 0) check_constant(residual, spin, options, scale);
    result.at = residual.at;
    return result;
}

}  // namespace cardan::solvers
