#include "solvers/time/detail/newton_matrix.hpp"

#include "mbs/base/error.hpp"

#include <nvector/nvector_serial.h>

namespace cardan::solvers {

namespace {

SUNMatrix_ID matrix_id(SUNMatrix) {
    return SUNMATRIX_CUSTOM;
}
SUNLinearSolver_Type solver_type(SUNLinearSolver) {
    return SUNLINEARSOLVER_DIRECT;
}
SUNLinearSolver_ID solver_id(SUNLinearSolver) {
    return SUNLINEARSOLVER_CUSTOM;
}
int no_setup(SUNLinearSolver, SUNMatrix) {
    return 0;  // factorised when it was formed
}
int solve_callback(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, realtype) {
    static_cast<NewtonMatrix*>(solver->content)->solve(N_VGetArrayPointer(b), N_VGetArrayPointer(x));
    return 0;
}

}  // namespace

NewtonMatrix::NewtonMatrix(EquationsOfMotion& equations, SUNContext context)
    : equations_(equations),
      start_(equations.size()),
      change_(equations.size()),
      rates_(equations.rates()),
      all_(Vector::Zero(equations.model().size())),
      reduced_(equations),
      matrix_(SUNMatNewEmpty(context)),
      solver_(SUNLinSolNewEmpty(context)) {
    if (!matrix_ || !solver_) throw NumericalError("SUNDIALS: no memory for a linear solver");
    matrix_->ops->getid = matrix_id;
    solver_->content = this;
    solver_->ops->gettype = solver_type;
    solver_->ops->getid = solver_id;
    solver_->ops->setup = no_setup;
    solver_->ops->solve = solve_callback;
}

bool NewtonMatrix::form(double time, const double* x, double c, bool fresh) {
    if (fresh || !has_jacobian_) {
        has_jacobian_ = false;
        if (!equations_.linearise(time, x)) return false;
        has_jacobian_ = true;
        ++jacobians;
    }
    c_ = c;
    reduced_.form({.qdd = 1, .qd = c, .q = c * c, .s_rate = 1, .s = c});
    ++factorisations;
    return true;
}

void NewtonMatrix::solve(const double* b, double* x) {
    const Eigen::Index m = start_.size();
    start_ = Eigen::Map<const Vector>(b, m);
    change_ = Eigen::Map<const Vector>(b + m, m);
    equations_.multiply_metric(change_, rates_);
    // The rows of the positions are linear: the first iteration leaves of their residual nothing but rounding. It
    // reaches the rates as b_1 / c at most, however stiff S is.
    if (start_.lpNorm<Eigen::Infinity>() > 1e-6 * c_ * change_.lpNorm<Eigen::Infinity>())
        equations_.subtract_stiffness(c_, start_, rates_);
    if (const Eigen::Index states = equations_.states(); states > 0) {
        equations_.spread(start_, all_);
        auto right = rates_.tail(states);
        right = Eigen::Map<const Vector>(b + 2 * m, states);
        right.noalias() += c_ * equations_.state_derivatives().f_q * all_;
    }
    reduced_.solve(rates_, change_);
    for (Eigen::Index i = 0; i < m; ++i) x[i] = start_(i) + c_ * rates_(i);
    std::copy_n(rates_.data(), rates_.size(), x + m);
}

}  // namespace cardan::solvers
