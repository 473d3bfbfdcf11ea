// A machine at a state, and the generalised forces of a field there.
#pragma once

#include "tests/support/catch.hpp"
#include "tests/turbines/machines/sampled_channels.hpp"

namespace cardan::testing {

/// A state of a machine with what evaluations need.
class FieldState {
public:
    FieldState(const turbines::Turbine& machine, const MachineState& state)
        : state_(state),
          workspace_(machine.system().model),
          kin_(kinematics(machine.system().model, state_.q, workspace_)) {}
    FieldState(const FieldState&) = delete;
    FieldState& operator=(const FieldState&) = delete;
    StateView input() const { return {state_, kin_}; }

private:
    MachineState state_;
    Workspace workspace_;
    Kinematics kin_;
};

inline Vector generalised_forces(const turbines::Turbine& machine, const WrenchField& field,
                                 const MachineState& state) {
    ForceSet only;
    only.add_field(field);
    const Forces forces(only, machine.system().model);
    const FieldState at(machine, state);
    Vector Q(state.q.size());
    forces.generalised_forces({state, at.input().kinematics}, Q);
    return Q;
}

/// Derivatives of a field without states against central differences.
/// @return dQ/dq, that of the field
/// @param noise_q, noise_qd  of the forces that are differenced, over the step and their largest derivative
inline Matrix checked_derivatives(const turbines::Turbine& machine, const WrenchField& field, const MachineState& state,
                                  double noise_q, double noise_qd) {
    const Eigen::Index n = state.q.size();
    Matrix by_q = Matrix::Zero(n, n), by_qd = Matrix::Zero(n, n), expected_q(n, n), expected_qd(n, n);
    field.jacobian(FieldState(machine, state).input(), by_q, by_qd);
    const double h = 1e-6;
    for (Eigen::Index a = 0; a < n; ++a) {
        const auto moved = [&](double dq, double dqd) {
            MachineState other = state;
            other.q(a) += dq;
            other.qd(a) += dqd;
            return generalised_forces(machine, field, other);
        };
        expected_q.col(a) = (moved(h, 0) - moved(-h, 0)) / (2 * h);
        expected_qd.col(a) = (moved(0, h) - moved(0, -h)) / (2 * h);
    }
    for (Eigen::Index a = 0; a < n; ++a) {
        CAPTURE(a, machine.system().model.coordinates()[static_cast<int>(a)].name);
        CHECK((by_q.col(a) - expected_q.col(a)).norm() < 1e-6 * expected_q.col(a).norm() + noise_q * expected_q.norm());
        CHECK((by_qd.col(a) - expected_qd.col(a)).norm() <
              1e-6 * expected_qd.col(a).norm() + noise_qd * expected_qd.norm());
    }
    return by_q;
}

}  // namespace cardan::testing
