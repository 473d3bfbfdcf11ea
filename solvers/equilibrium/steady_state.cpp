#include "solvers/equilibrium/steady_state.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/detail/sundials_memory.hpp"
#include "solvers/equilibrium/detail/closed_start.hpp"
#include "solvers/equilibrium/detail/steady_residual.hpp"
#include "solvers/equilibrium/detail/stiffness_solver.hpp"

#include <kinsol/kinsol.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace cardan::solvers {

namespace {

void free_kinsol(void* memory) {
    KINFree(&memory);
}

// Exceptions must not cross KINSOL: kept and rethrown outside.
template <class F>
int guarded(void* user, F f) {
    auto* residual = static_cast<SteadyResidual*>(user);
    try {
        f(*residual);
        return 0;
    } catch (...) {
        residual->thrown = std::current_exception();
        return -1;
    }
}

int residual_callback(N_Vector x, N_Vector r, void* user) {
    return guarded(user, [&](SteadyResidual& residual) {
        residual.set(N_VGetArrayPointer(x));
        residual.evaluate(N_VGetArrayPointer(r));
    });
}

int jacobian_callback(N_Vector x, N_Vector, SUNMatrix J, void* user, N_Vector, N_Vector) {
    return guarded(user, [&](SteadyResidual& residual) {
        residual.set(N_VGetArrayPointer(x));
        residual.jacobian(SUNDenseMatrix_Data(J));
    });
}

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
            return "the stiffness matrix is singular (a mechanism, buckling, or a state that nothing determines)";
        case KIN_SYSFUNC_FAIL:
        case KIN_FIRST_SYSFUNC_ERR:
            return "the residual could not be evaluated";
        default:
            return "KINSOL reported an error";
    }
}

}  // namespace

class SteadySolver::Memory {
public:
    Memory(const System& system, int spin, bool trimmed, std::vector<int> loops = {});
    /// @param lambda  multipliers at the start
    void solve(const SteadyOptions& options, SteadyState& result, const Vector& lambda = {});
    /// The loops' independent equations at a start that is closed, and their multipliers there.
    LoopStart loops_at(const SteadyOptions& options);
    bool trimmed() const { return residual_.trimmed; }

private:
    void check(const SteadyOptions& options) const;
    void set_scale();
    void set_units();
    void set_loop_scales();
    int run(const SteadyOptions& options, long& iterations);
    double largest_residual();
    void check_constant(const SteadyOptions& options);
    bool check_closed(SteadyState& result);

    int spin_, coordinates_;
    SteadyResidual residual_;
    Vector scale_, r_;
    Vector units_;  ///< what counts as much of the unknown coordinates: 1 rad, or the extent of the tree
    // The order matters: members are destroyed in reverse, KINSOL first, the context last.
    SundialsContext context_;
    SundialsVector x_, x_scale_, f_scale_;
    SundialsMatrix J_;
    std::optional<StiffnessSolver> linear_;
    std::unique_ptr<void, SundialsDeleter<free_kinsol>> kinsol_;
};

SteadySolver::Memory::Memory(const System& system, int spin, bool trimmed, std::vector<int> loops)
    : spin_(spin), coordinates_(system.model.size()), residual_(system, spin, trimmed, std::move(loops)) {
    const auto n = static_cast<sunindextype>(residual_.size());
    if (n == 0) return;
    scale_.resize(n);
    r_.resize(n);
    units_.setOnes(std::ssize(residual_.unknowns));
    context_ = make_sundials_context();
    SUNContext context = context_.get();
    for (SundialsVector* v : {&x_, &x_scale_, &f_scale_}) v->reset(N_VNew_Serial(n, context));
    N_VConst(1.0, x_scale_.get());
    for (std::size_t i = 0; i < residual_.states.size(); ++i)
        N_VGetArrayPointer(x_scale_.get())[residual_.unknowns.size() + i] = 1 / residual_.scale_of(i);
    J_.reset(SUNDenseMatrix(n, n, context));
    linear_.emplace(n, context);
    kinsol_.reset(KINCreate(context));
    void* kin = kinsol_.get();
    const bool ok = KINInit(kin, residual_callback, x_.get()) == 0 && KINSetUserData(kin, &residual_) == 0 &&
                    KINSetErrHandlerFn(kin, sundials_quiet, nullptr) == 0 &&
                    KINSetLinearSolver(kin, linear_->handle(), J_.get()) == 0 &&
                    KINSetJacFn(kin, jacobian_callback) == 0 && KINSetMaxSetupCalls(kin, 1) == 0 &&
                    KINSetScaledStepTol(kin, 1e-14) == 0;
    if (!ok) throw NumericalError("SUNDIALS: KINSOL could not be set up");
}

void SteadySolver::Memory::check(const SteadyOptions& options) const {
    if (!std::isfinite(options.rotor_speed) || !std::isfinite(options.azimuth))
        throw InputError("steady state", "rotor speed [rad/s], azimuth [rad]",
                         text(options.rotor_speed, ", ", options.azimuth), "finite");
    if (spin_ < 0 && options.rotor_speed != 0)
        throw InputError("steady state", "rotor speed [rad/s]", options.rotor_speed, "0 for a system without rotor");
    if (options.initial.size() != 0 && options.initial.size() != coordinates_)
        throw InputError("steady state", "size of the starting point", options.initial.size(),
                         text(coordinates_, ", one per coordinate, or empty"));
    for (Eigen::Index i = 0; i < options.initial.size(); ++i)
        if (!std::isfinite(options.initial(i)))
            throw InputError("steady state", text("coordinate number ", i, " of the starting point"),
                             options.initial(i), "finite");
    const StateTable& states = residual_.table();
    if (options.states.size() != 0 && options.states.size() != states.size())
        throw InputError("steady state", "number of states of the starting point", options.states.size(),
                         text(states.size(), ", or empty"));
    for (int i = 0; i < static_cast<int>(options.states.size()); ++i)
        if (!std::isfinite(options.states(i)))
            throw InputError("steady state", text("state '", states[i].name, "' of the starting point"),
                             options.states(i), "finite");
    if (options.inputs.size() != 0 && options.inputs.size() != residual_.inputs().size())
        throw InputError("steady state", "number of inputs", options.inputs.size(),
                         text(residual_.inputs().size(), ", or empty"));
    if (options.trim && spin_ < 0) throw InputError("steady state", "trim", "given", "none for a system without rotor");
    require_positive("steady state", "tolerance", options.tolerance);
    if (options.iterations < 1) throw InputError("steady state", "limit of iterations", options.iterations, ">= 1");
}

// Lengths are measured by the extent of the tree; of a tree without any, by where it is and how far the first step of
// Newton's method would go.
void SteadySolver::Memory::set_units() {
    const Eigen::Index size = scale_.size();
    double length = residual_.tree_extent();
    if (!(length > 0)) {
        residual_.evaluate(r_.data());
        for (Eigen::Index i = 0; i < units_.size(); ++i) {
            if (residual_.is_angle(i)) continue;
            const double stiffness = std::abs(SUNDenseMatrix_Data(J_.get())[i * (size + 1)]);
            length = std::max(length, std::abs(residual_.at.q(entry(residual_.unknowns, i))));
            if (stiffness > 0) length = std::max(length, std::abs(r_(i)) / stiffness);
        }
    }
    for (Eigen::Index i = 0; i < units_.size(); ++i) {
        units_(i) = residual_.is_angle(i) || !(length > 0) ? 1 : length;
        N_VGetArrayPointer(x_scale_.get())[i] = 1 / units_(i);
    }
}

// Residuals are measured by the stiffness on the diagonal, so that they read as coordinates in their units; by a
// millionth of the springs at least, for at a critical load they and the loads cancel.
void SteadySolver::Memory::set_scale() {
    if (residual_.trimmed) N_VGetArrayPointer(x_scale_.get())[residual_.size() - 1] = 1 / residual_.scale_of_trim();
    residual_.jacobian(SUNDenseMatrix_Data(J_.get()));
    set_units();
    const Eigen::Index size = scale_.size(), n = std::ssize(residual_.unknowns);
    // Energies at one unit.
    const auto stiffness = [&](Eigen::Index i) {
        return std::abs(SUNDenseMatrix_Data(J_.get())[i * (size + 1)]) * units_(i) * units_(i);
    };
    const auto spring = [&](Eigen::Index i) { return std::abs(residual_.elastic_diagonal(i)) * units_(i) * units_(i); };
    double stiffest = 1e-280;
    for (Eigen::Index i = 0; i < n; ++i) stiffest = std::max({stiffest, stiffness(i), spring(i)});
    for (Eigen::Index i = 0; i < n; ++i) {
        const double scale = units_(i) / std::max({stiffness(i), 1e-6 * spring(i), 1e-12 * stiffest});
        scale_(i) = N_VGetArrayPointer(f_scale_.get())[i] = scale;
    }
    if (!residual_.loops.empty()) set_loop_scales();
    // Of states and a trim, by how much rate or torque changes with what counts as much of everything it depends on.
    const Eigen::Map<const Matrix> J(SUNDenseMatrix_Data(J_.get()), size, size);
    const Eigen::Map<const Vector> units(N_VGetArrayPointer(x_scale_.get()), size);
    const Eigen::Index first_loop = n + std::ssize(residual_.states), end = first_loop + std::ssize(residual_.loops);
    for (Eigen::Index i = n; i < size; ++i) {
        if (i >= first_loop && i < end) continue;
        double sensitivity = 0;
        for (Eigen::Index j = 0; j < size; ++j)
            if (j < first_loop || j >= end) sensitivity += std::abs(J(i, j)) / units(j);
        scale_(i) = N_VGetArrayPointer(f_scale_.get())[i] = 1 / std::max(sensitivity, 1e-280);
    }
}

// Mechanisms may have no stiffness: there the loads that balance one another are what a residual is measured by, so
// that it reads as an angle or a length all the same. Equations of loops are measured by their size. Multipliers enter
// linearly and must not limit a step: what counts as much of them is a million times what moves a coordinate by a unit.
void SteadySolver::Memory::set_loop_scales() {
    constexpr double much = 1e6;
    const Eigen::Index n = std::ssize(residual_.unknowns), first = n + std::ssize(residual_.states);
    for (Eigen::Index i = 0; i < n; ++i)
        if (const double load = residual_.load(i); load > 0)
            scale_(i) = N_VGetArrayPointer(f_scale_.get())[i] = std::min(scale_(i), 1 / load);
    const Vector sizes = residual_.loop_sizes();
    for (Eigen::Index k = 0; k < std::ssize(residual_.loops); ++k) {
        const int equation = entry(residual_.loops, k);
        double moves = 1e-280;
        for (Eigen::Index i = 0; i < n; ++i)
            moves = std::max(moves, std::abs(residual_.loop_gradient(equation, i)) * scale_(i));
        scale_(first + k) = N_VGetArrayPointer(f_scale_.get())[first + k] = 1 / sizes(equation);
        N_VGetArrayPointer(x_scale_.get())[first + k] = moves / much;
    }
}

double SteadySolver::Memory::largest_residual() {
    residual_.evaluate(r_.data());
    if (!r_.allFinite()) return std::numeric_limits<double>::quiet_NaN();
    return r_.cwiseProduct(scale_).cwiseAbs().maxCoeff();
}

void SteadySolver::Memory::check_constant(const SteadyOptions& options) {
    // An angle that is no multiple of the spacing of any usual number of blades.
    for (double turn : {1.0, 2.5}) {
        residual_.turn_to(options.azimuth + turn);
        const double largest = largest_residual();
        if (!(largest < 1e-7))
            throw NumericalError(text(
                "no constant steady state at ", residual_.speed(), " rad/s: with the rotor turned by ", turn,
                " rad the forces leave a residual of ", largest,
                " (residual over stiffness; allowed 1e-7). Gravity in rotation, an unbalanced or a "
                "two-bladed rotor have a periodic steady state: see harmonic_balance(); or leave gravity out or stop "
                "the rotor"));
    }
    residual_.turn_to(options.azimuth);
}

LoopStart SteadySolver::Memory::loops_at(const SteadyOptions& options) {
    check(options);
    residual_.start(options);
    return residual_.start_of_loops();
}

// Also of the equations that were left out as redundant.
bool SteadySolver::Memory::check_closed(SteadyState& result) {
    if (residual_.at.lambda.size() == 0) return true;
    double gap = 0;
    const int open = residual_.open_by(1e-8, gap);
    if (open < 0) return true;
    const Loops::Equation& equation = entry(residual_.system_loops().equations(), open);
    result.message =
        text("steady state with an open loop: ", residual_.system_loops().describe(equation.loop), " leaves ", gap, " ",
             equation.unit, " (", equation.name, "); its equations contradict those of others");
    return false;
}

// A single step of Newton's method goes no further than ten units, which keeps angles from going round and round; where
// one such step after the other is taken the solution is far away, and they become longer.
int SteadySolver::Memory::run(const SteadyOptions& options, long& iterations) {
    void* kin = kinsol_.get();
    iterations = 0;
    for (double longest = 10;; longest *= 10) {
        const bool ok = KINSetNumMaxIters(kin, options.iterations - iterations) == 0 &&
                        KINSetFuncNormTol(kin, options.tolerance) == 0 && KINSetMaxNewtonStep(kin, longest) == 0;
        if (!ok) throw NumericalError("SUNDIALS: KINSOL could not be set up");
        const int flag = KINSol(kin, x_.get(), KIN_LINESEARCH, x_scale_.get(), f_scale_.get());
        if (residual_.thrown) std::rethrow_exception(residual_.thrown);
        long now = 0;
        KINGetNumNonlinSolvIters(kin, &now);
        iterations += now;
        if (flag != KIN_MXNEWT_5X_EXCEEDED || iterations >= options.iterations) return flag;
    }
}

void SteadySolver::Memory::solve(const SteadyOptions& options, SteadyState& result, const Vector& lambda) {
    result.converged = false;  // until it is known to be, also if something throws
    result.message.clear();
    check(options);
    residual_.start(options);
    if (lambda.size() > 0) residual_.at.lambda = lambda;
    if (residual_.size() == 0) {
        result.converged = true;
        result.at = residual_.at;
        result.residual = result.iterations = 0;
        return;
    }
    set_scale();
    double* x = N_VGetArrayPointer(x_.get());
    residual_.get(x);
    long iterations = 0;
    const int flag = run(options, iterations);
    residual_.set(x);
    result.residual = largest_residual();
    result.iterations = static_cast<int>(iterations);
    // A step too small to improve on is as good as the arithmetic allows if the residual is small as well.
    const bool converged = flag >= 0 && result.residual < std::max(1e-8, options.tolerance);
    result.at = residual_.at;
    if (!converged)
        result.message = text("steady state not found after ", iterations, " iterations (residual over stiffness ",
                              result.residual, ", wanted ", options.tolerance, "): ", reason(flag),
                              "; start from a neighbouring state or approach the load in steps");
    if (converged && residual_.speed() != 0) check_constant(options);
    result.converged = converged && check_closed(result);
}

namespace {

// In words, only if there is none.
struct MemoryOf {
    const System& system;
    std::string operator()() const { return text("the steady state of ", system.model.size(), " coordinates"); }
};

}  // namespace

SteadySolver::SteadySolver(const System& system, int spin) : system_(system), spin_(spin) {
    if (spin < -1 || spin >= system.model.size())
        throw InputError("steady state", "index of the spin coordinate", spin,
                         text("-1 (none) ... ", system.model.size() - 1));
    memory_ = with_memory(MemoryOf{system}, [&] { return std::make_unique<Memory>(system, spin, false); });
}

SteadySolver::~SteadySolver() = default;

void SteadySolver::solve(const SteadyOptions& options, SteadyState& result) {
    with_memory(MemoryOf{system_}, [&] {
        if (!system_.loops.empty()) return solve_closed(options, result);
        if (memory_->trimmed() != options.trim.has_value())
            memory_ = std::make_unique<Memory>(system_, spin_, options.trim.has_value());
        memory_->solve(options, result);
    });
}

// Which equations are independent is seen at the closed position next to the start.
void SteadySolver::solve_closed(const SteadyOptions& options, SteadyState& result) {
    SteadyOptions closed = options;
    Vector& q = closed.initial;
    if (q.size() == 0) q.setZero(system_.model.size());
    if (spin_ >= 0 && spin_ < q.size()) q(spin_) = options.azimuth;
    q = closed_position(system_, spin_, 0, q);
    const LoopStart loops = memory_->loops_at(closed);
    memory_ = std::make_unique<Memory>(system_, spin_, options.trim.has_value(), loops.equations);
    memory_->solve(closed, result, loops.lambda);
}

SteadyState steady_state(const System& system, int spin, const SteadyOptions& options) {
    SteadyState result;
    SteadySolver(system, spin).solve(options, result);
    return result;
}

}  // namespace cardan::solvers
