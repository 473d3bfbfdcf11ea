// Plain twin: tests/mbs/kernels/plain_dynamics.hpp
#include "mbs/system/forward_derivatives.hpp"

namespace cardan {

ForwardDynamicsDerivatives::ForwardDynamicsDerivatives(const Model& model)
    : ForwardDynamicsDerivatives(model, model.coordinates().driven()) {}

ForwardDynamicsDerivatives::ForwardDynamicsDerivatives(const Model& model, std::vector<bool> driven)
    : factor_(model, std::move(driven)) {
    const int n = model.size();
    for (int a = 0; a < n; ++a)
        if (factor_.is_driven(a)) driven_.push_back(a);
    for (Matrix* m : {&g_, &residual_q_, &residual_qd_, &by_q_, &by_qd_, &by_Q_, &by_prescribed_, &actuator_by_q_,
                      &actuator_by_qd_, &actuator_by_Q_, &actuator_by_prescribed_})
        m->setZero(n, n);
}

PivotStatus ForwardDynamicsDerivatives::compute(const Kinematics& kin, VectorIn qd, VectorIn qdd,
                                                const ForceDerivatives* forces) {
    require_model("derivatives of the forward dynamics", "kinematics", kin.model().serial(), factor_.model().serial());
    metric(kin, g_);
    const PivotStatus status = factor_.factorise(g_);
    if (!status) return status;
    // residual = d(tau - Q)/dx at fixed qdd; ForceDerivatives hold -dQ/dx. (Armatures depend on qdd alone.)
    inverse_dynamics_derivatives(kin, qd, qdd, residual_q_, residual_qd_);
    if (forces != nullptr) {
        const Eigen::Index n = kin.model().size();
        for (const Matrix* m : {&forces->elastic, &forces->gravity, &forces->loads, &forces->damping})
            require_size("derivatives of the forward dynamics", "derivatives of forces", *m, n, n);
        residual_q_ += forces->elastic + forces->gravity + forces->loads;
        residual_qd_ += forces->damping;
    }
    solve_free_rows();
    drive_rows(residual_q_, by_q_, actuator_by_q_);
    drive_rows(residual_qd_, by_qd_, actuator_by_qd_);
    for (const int d : driven_) {
        actuator_by_Q_.row(d).noalias() = g_.row(d).lazyProduct(by_Q_);
        actuator_by_Q_(d, d) -= 1;
        actuator_by_prescribed_.row(d).noalias() = g_.row(d).lazyProduct(by_prescribed_);
    }
    return status;
}

void ForwardDynamicsDerivatives::solve_free_rows() {
    by_q_ = -residual_q_;
    by_qd_ = -residual_qd_;
    by_Q_.setIdentity();
    for (const int d : driven_) {
        by_q_.row(d).setZero();
        by_qd_.row(d).setZero();
        by_Q_(d, d) = 0;
        by_prescribed_.col(d) = -g_.col(d);
        for (const int other : driven_) by_prescribed_(other, d) = other == d ? 1.0 : 0.0;
        factor_.solve(by_prescribed_.col(d));
    }
    factor_.solve(by_q_);
    factor_.solve(by_qd_);
    factor_.solve(by_Q_);
}

// dA_d/dx = dtau_d/dx|qdd - dQ_d/dx + g_df dqdd_f/dx; the rows of driven accelerations are zero.
void ForwardDynamicsDerivatives::drive_rows(const Matrix& residual, const Matrix& accelerations,
                                            Matrix& actuator) const {
    for (const int d : driven_) {
        actuator.row(d).noalias() = g_.row(d).lazyProduct(accelerations);
        actuator.row(d) += residual.row(d);
    }
}

}  // namespace cardan
