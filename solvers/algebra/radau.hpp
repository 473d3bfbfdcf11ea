/// @file
/// Radau's collocation methods for equations of second order whose matrices differ from stage to stage.
#pragma once

#include "solvers/algebra/dense.hpp"

namespace cardan::solvers {

/// Coefficients of Radau's method IIA with s stages: collocation at the zeros of P_s - P_{s-1} (Legendre), mapped to
/// [0, 1]. Order 2 s - 1 at the end of a step, stiffly accurate, L-stable: motions too fast for the step die out.
///                                            [Hairer and Wanner, Solving Ordinary Differential Equations II, IV.5]
struct RadauIIA {
    /// @throws InputError unless 1 <= stages <= 9
    explicit RadauIIA(int stages);

    Eigen::Index stages() const { return c.size(); }
    int order() const { return 2 * static_cast<int>(stages()) - 1; }

    Vector c;   ///< nodes, ascending; the last one is 1
    Matrix A;   ///< integrals of the Lagrange polynomials from 0 to the nodes
    Matrix A2;  ///< A A
};

/// Linear algebra of one step h of M q'' + C q' + K q = f, with the matrices given at the stages. The unknowns are the
/// accelerations a_i at the stages; positions and rates there are
///
///     q_i = q + c_i h v + h^2 sum_j (A^2)_ij a_j,   v_i = v + h sum_j A_ij a_j.
///
/// The last rows may be states s of first order (append_states(): no second derivatives), of which the unknowns are the
/// rates w_i, with s_i = s + h sum_j A_ij w_j.
class RadauStage {
public:
    /// @param states  how many of the rows are of first order
    RadauStage(const RadauIIA& method, Eigen::Index rows, Eigen::Index states = 0);

    /// All stages must be set before factorise().
    void set(Eigen::Index stage, double h, const Matrix& M, const Matrix& C, const Matrix& K);
    /// Cost 2/3 (s n)^3.
    void factorise();
    /// Accelerations and rates of states at the stages from right-hand sides f at the stages, in place, s n rows.
    void solve(Matrix& f) const;
    /// Solutions of the homogeneous equations at the end of the step, from unit positions, unit rates and unit states.
    /// @param Phi  out: positions above rates above states
    void transition(double h, Matrix& Phi);

private:
    const RadauIIA* method_;
    Eigen::Index n_, second_;  ///< rows, and how many are of second order
    Matrix right_;
    std::vector<Matrix> C_, K_;
    LuFactors factors_;
};

}  // namespace cardan::solvers
