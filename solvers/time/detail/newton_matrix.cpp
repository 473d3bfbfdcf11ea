#include "solvers/time/detail/newton_matrix.hpp"

#include "mbs/base/error.hpp"

#include <nvector/nvector_serial.h>

#include <algorithm>
#include <cmath>

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
// Factors for steps that differ by less than this, relative, are the same to Newton's method.
constexpr double same_step = 1e-6;

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
      point_{.x = Vector::Zero(equations.length()),
             .u = equations.inputs(),
             .driven = Vector::Zero(3 * std::ssize(equations.drives()))},
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
        hold_jacobian(time, x);
        ++jacobians;
    } else if (std::abs(c - c_) < same_step * c) {
        return true;
    }
    factorise(c);
    ++factorisations;
    return true;
}

// It has been taken there.
void NewtonMatrix::hold_jacobian(double time, const double* x) {
    has_jacobian_ = true;
    point_.time = time;
    std::copy_n(x, point_.x.size(), point_.x.data());
    point_.u = equations_.inputs();
    equations_.driven_state(point_.driven.data());
}

void NewtonMatrix::factorise(double c) {
    c_ = c;
    reduced_.form({.qdd = 1, .qd = c, .q = c * c, .s_rate = 1, .s = c});
}

int NewtonMatrix::memory(const EquationsOfMotion& equations) {
    return 2 + equations.length() + static_cast<int>(equations.inputs().size() + 3 * std::ssize(equations.drives()));
}

void NewtonMatrix::remember(double* out) const {
    *out++ = has_jacobian_ ? c_ : 0;
    *out++ = point_.time;
    for (const Vector* part : {&point_.x, &point_.u, &point_.driven}) out = std::copy(part->begin(), part->end(), out);
}

void NewtonMatrix::recall(const double* memory) {
    const double c = memory[0], time = memory[1], *const x = memory + 2, *const u = x + point_.x.size(),
                 *const driven = u + point_.u.size();
    const auto is = [](const Vector& own, const double* other) { return std::equal(own.begin(), own.end(), other); };
    if (has_jacobian_ && c_ == c && point_.time == time && is(point_.x, x) && is(point_.u, u) &&
        is(point_.driven, driven))
        return;
    has_jacobian_ = false;
    if (c == 0) return;
    const Vector inputs = equations_.inputs();
    equations_.set_inputs(Eigen::Map<const Vector>(u, inputs.size()));
    if (equations_.linearise(time, x, driven)) {
        hold_jacobian(time, x);
        factorise(c);
    }
    equations_.set_inputs(inputs);
}

void NewtonMatrix::solve(const double* b, double* x) {
    ++solutions;
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
