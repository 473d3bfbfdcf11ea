/// @file
/// The matrix of Newton's method for implicit methods of first order, as SUNDIALS' linear solver. For sources only.
#pragma once

#include "solvers/algebra/dense.hpp"
#include "solvers/time/equations_of_motion.hpp"

#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <memory>

namespace cardan::solvers {

/// M = I - c J of x = (q, qd), J = [0 I; A B], A = dqdd/dq, B = dqdd/dqd. The positions are eliminated:
///   (I - c B - c^2 A) x_2 = b_2 + c A b_1,   x_1 = b_1 + c x_2,
/// so that a matrix of half the size is factorised: an eighth of the work.
///
/// Cost O(n^3) to form, O(n^2) to solve; allocates nothing.
class NewtonMatrix {
public:
    NewtonMatrix(EquationsOfMotion& equations, SUNContext context);

    /// @param fresh  evaluates A and B at the state; otherwise the previous ones are reused
    /// @return false if they cannot be evaluated; problem() of the equations says why
    bool form(double time, const double* x, double c, bool fresh);
    /// x = M^-1 b, both of size 2 n; may be the same
    void solve(const double* b, double* x);

    /// Handles for SUNDIALS that refer to this object and live as long as it does.
    SUNMatrix matrix() { return matrix_.get(); }
    SUNLinearSolver solver() { return solver_.get(); }

    long jacobians = 0, factorisations = 0;

private:
    struct FreeMatrix {
        void operator()(SUNMatrix m) const { SUNMatFreeEmpty(m); }
    };
    struct FreeSolver {
        void operator()(SUNLinearSolver s) const { SUNLinSolFreeEmpty(s); }
    };

    EquationsOfMotion& equations_;
    double c_ = 0;
    bool has_jacobian_ = false;
    Vector rates_;
    LuFactors reduced_;
    std::unique_ptr<std::remove_pointer_t<SUNMatrix>, FreeMatrix> matrix_;
    std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, FreeSolver> solver_;
};

}  // namespace cardan::solvers
