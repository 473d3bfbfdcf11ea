/// @file
/// Exact first derivatives of the forward dynamics.
#pragma once

#include "mbs/kernels/derivatives.hpp"
#include "mbs/kernels/metric_factor.hpp"
#include "mbs/system/forces.hpp"

namespace cardan {

/// Derivatives of the accelerations qdd(q, qd, Q) of the free coordinates f and of the drives' forces A on the driven
/// coordinates d, whose accelerations are prescribed. From tau(q, qd, qdd) = g qdd + Gamma qd qd = Q + A, A_f = 0,
///
///     g_ff dqdd_f/dx = dQ_f/dx - dtau_f/dx|qdd          x = q, qd (of all coordinates)
///
///     dqdd_f/dQ_f = g_ff^-1,        dqdd_f/dqdd_d = -g_ff^-1 g_fd
///
///     dA_d/dx = dtau_d/dx|qdd + g_df dqdd_f/dx - dQ_d/dx
///     dA_d/dQ_f = g_df g_ff^-1,          dA_d/dQ_d = -1,        dA_d/dqdd_d = g_dd + g_df dqdd_f/dqdd_d.
///
/// The right-hand sides come from the differentiated recursion, g_ff^-1 from the branch-sparse factor.
///                          [Jain and Rodriguez 1993; Carpentier and Mansard 2018; Singh, Russell and Wensing 2022]
///
/// Cost O(n^2 d): n columns of O(n d) each. Nothing allocates after construction; one object per thread.
class ForwardDynamicsDerivatives {
public:
    /// Driven are the coordinates that have this role in the coordinate table.
    explicit ForwardDynamicsDerivatives(const Model& model);
    explicit ForwardDynamicsDerivatives(Model&&) = delete;  // the model must live longer
    /// @param driven  size n; true where the acceleration is prescribed
    /// @throws InputError if `driven` has another size.
    ForwardDynamicsDerivatives(const Model& model, std::vector<bool> driven);

    /// @param qd   rates, size n
    /// @param qdd  accelerations of all coordinates at this state, as ForwardDynamics::solve() returns them
    /// @param forces  Forces::derivatives() at the state, if Q depends on q and qd; nullptr: Q is held fixed
    ///
    /// After a failure (metric of the free coordinates not positive definite) the results are undefined.
    PivotStatus compute(const Kinematics& kin, VectorIn qd, VectorIn qdd, const ForceDerivatives* forces = nullptr);

    /// n x n, row a: acceleration of coordinate a, column b: position, rate, generalised force of coordinate b. Rows of
    /// driven coordinates are zero; so are the columns of driven coordinates in dqdd_dQ.
    const Matrix& dqdd_dq() const { return by_q_; }
    const Matrix& dqdd_dqd() const { return by_qd_; }
    const Matrix& dqdd_dQ() const { return by_Q_; }
    /// n x n, column b: by the prescribed acceleration of the driven coordinate b (1 in row b); other columns are zero.
    const Matrix& dqdd_dprescribed() const { return by_prescribed_; }

    /// Derivatives of the forces A that the drives add to Q (`actuator` of ForwardDynamics::solve()); rows of free
    /// coordinates are zero.
    const Matrix& dactuator_dq() const { return actuator_by_q_; }
    const Matrix& dactuator_dqd() const { return actuator_by_qd_; }
    const Matrix& dactuator_dQ() const { return actuator_by_Q_; }
    const Matrix& dactuator_dprescribed() const { return actuator_by_prescribed_; }

    /// g_ff = L^T L at the last state.
    MetricFactor& factor() { return factor_; }

private:
    void solve_free_rows();
    void drive_rows(const Matrix& residual, const Matrix& accelerations, Matrix& actuator) const;

    MetricFactor factor_;
    std::vector<int> driven_;  ///< indices
    Matrix g_, residual_q_, residual_qd_, by_q_, by_qd_, by_Q_, by_prescribed_;
    Matrix actuator_by_q_, actuator_by_qd_, actuator_by_Q_, actuator_by_prescribed_;
};

}  // namespace cardan
