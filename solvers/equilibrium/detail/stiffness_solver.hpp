/// @file
/// The linear solver of Newton's iteration for steady states.
#pragma once

#include "mbs/base/error.hpp"
#include "solvers/algebra/dense.hpp"

#include <sundials/sundials_linearsolver.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <memory>
#include <type_traits>

namespace cardan::solvers {

/// LuFactors as SUNDIALS' linear solver. Its own goes number by number.
class StiffnessSolver {
public:
    StiffnessSolver(Eigen::Index n, SUNContext context) : factors_(n), b_(n), solver_(SUNLinSolNewEmpty(context)) {
        if (!solver_) throw NumericalError("SUNDIALS: no memory for a linear solver");
        solver_->content = this;
        solver_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
        solver_->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
        solver_->ops->setup = setup;
        solver_->ops->solve = solve;
    }
    StiffnessSolver(const StiffnessSolver&) = delete;  // the handle refers to this object
    StiffnessSolver& operator=(const StiffnessSolver&) = delete;
    ~StiffnessSolver() = default;

    SUNLinearSolver handle() { return solver_.get(); }

private:
    static StiffnessSolver& self(SUNLinearSolver s) { return *static_cast<StiffnessSolver*>(s->content); }
    static int setup(SUNLinearSolver s, SUNMatrix A) {
        LuFactors& factors = self(s).factors_;
        const Eigen::Index n = self(s).b_.size();
        factors.matrix() = Eigen::Map<const Matrix>(SUNDenseMatrix_Data(A), n, n);
        factors.factorise();
        return factors.regular() ? 0 : 1;
    }
    static int solve(SUNLinearSolver s, SUNMatrix, N_Vector x, N_Vector b, realtype) {
        Vector& own = self(s).b_;
        own = Eigen::Map<const Vector>(N_VGetArrayPointer(b), own.size());
        self(s).factors_.solve(own);
        Eigen::Map<Vector>(N_VGetArrayPointer(x), own.size()) = own;
        return 0;
    }

    struct FreeSolver {
        void operator()(SUNLinearSolver s) const { SUNLinSolFreeEmpty(s); }
    };
    LuFactors factors_;
    Vector b_;
    std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, FreeSolver> solver_;
};

}  // namespace cardan::solvers
