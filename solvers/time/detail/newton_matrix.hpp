/// @file
/// The matrix of Newton's method for implicit methods of first order, as SUNDIALS' linear solver. For sources only.
#pragma once

#include "solvers/time/detail/tangent_factors.hpp"

#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <memory>

namespace cardan::solvers {

/// M = I - c J of x = (q, qd), J = [0 I; -g^-1 S, -g^-1 C] with the derivatives S, C of the residual. The positions are
/// eliminated, and the rest is multiplied by the metric, which gives it the pattern of the tree:
///   (g + c C + c^2 S) x_2 = g b_2 - c S b_1,   x_1 = b_1 + c x_2.
/// With states s, x = (q, qd, s), further terms couple x_2 and x_3:
///   (g + c C + c^2 S) x_2 - c Q_s x_3 = g b_2 - c S b_1,
///   -(c f_qd + c^2 f_q) x_2 + (1 - c f_s) x_3 = b_3 + c f_q b_1.
///
/// With loops the accelerations are held to their constraints, G x_2 = G b_2.
///
/// Cost O(n d^2) to form, O(n d) to solve, d the depth of the tree; allocates nothing.
class NewtonMatrix {
public:
    NewtonMatrix(EquationsOfMotion& equations, SUNContext context);

    /// @param fresh  evaluates g, C and S at the state; otherwise the previous ones are reused
    /// @return false if they cannot be evaluated; problem() of the equations says why
    bool form(double time, const double* x, double c, bool fresh);
    /// x = M^-1 b, both of the length of x; may be the same
    void solve(const double* b, double* x);

    /// Number of values that describe it: where the Jacobian was taken, and for what c it was factorised.
    static int memory(const EquationsOfMotion& equations);
    /// @param out  memory() numbers; the first is zero if there is no Jacobian
    void remember(double* out) const;
    /// Takes the matrix that was remembered, to the last digit. It has none if that cannot be evaluated.
    void recall(const double* memory);
    bool has_jacobian() const { return has_jacobian_; }

    /// Handles for SUNDIALS that refer to this object and live as long as it does.
    SUNMatrix matrix() { return matrix_.get(); }
    SUNLinearSolver solver() { return solver_.get(); }

    long jacobians = 0, factorisations = 0, solutions = 0;

private:
    struct FreeMatrix {
        void operator()(SUNMatrix m) const { SUNMatFreeEmpty(m); }
    };
    struct FreeSolver {
        void operator()(SUNLinearSolver s) const { SUNLinSolFreeEmpty(s); }
    };

    void hold_jacobian(double time, const double* x);
    void factorise(double c);

    EquationsOfMotion& equations_;
    double c_ = 0;
    bool has_jacobian_ = false;
    struct Point {
        double time = 0;
        Vector x, u, driven;  ///< EquationsOfMotion::driven_state()
    };
    Point point_;                    ///< where the Jacobian was taken
    Vector start_, change_, rates_;  ///< b_1, b_2, (x_2, x_3)
    Vector all_;                     ///< by coordinates
    TangentFactors reduced_;
    std::unique_ptr<std::remove_pointer_t<SUNMatrix>, FreeMatrix> matrix_;
    std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, FreeSolver> solver_;
};

}  // namespace cardan::solvers
