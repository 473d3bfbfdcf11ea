// A machine at a state, and the generalised forces of a field there.
#pragma once

#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/sampled_channels.hpp"

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

inline Vector generalised_forces(const turbines::Turbine& machine, const ForceElement& field,
                                 const MachineState& state) {
    ForceSet only;
    only.add_element(field);
    const Forces forces(only, machine.system().model);
    const FieldState at(machine, state);
    Vector Q(state.q.size());
    forces.generalised_forces({state, at.input().kinematics}, Q);
    return Q;
}

/// What an element without states and inputs answers; its functions alone, for the allocations that they make.
class ElementAnswers {
public:
    ElementAnswers(const ForceElement& element, Eigen::Index coordinates)
        : element_(element),
          by_q(Matrix::Zero(coordinates, coordinates)),
          by_qd(by_q),
          wrenches(element.points.size()),
          Q_(Vector::Zero(coordinates)),
          columns_(coordinates, 0),
          rows_(0, coordinates) {}
    void evaluate(const StateView& at) {
        ElementForces out{Q_, none_, wrenches};
        element_.evaluate(at, out);
    }
    void differentiate(const StateView& at) {
        ElementJacobian out{by_q, by_qd, columns_, columns_, columns_, rows_, rows_, nothing_, nothing_, nothing_};
        element_.jacobian(at, out);
    }

private:
    const ForceElement& element_;

public:
    Matrix by_q, by_qd;
    std::vector<Wrench> wrenches;

private:
    Vector Q_, none_;
    Matrix columns_, rows_, nothing_;
};

/// Derivatives of a field without states against central differences.
/// @return dQ/dq, that of the field
/// @param noise_q, noise_qd  of the forces that are differenced, over the step and their largest derivative
inline Matrix checked_derivatives(const turbines::Turbine& machine, const ForceElement& field,
                                  const MachineState& state, double noise_q, double noise_qd) {
    const Eigen::Index n = state.q.size();
    Matrix expected_q(n, n), expected_qd(n, n);
    ElementAnswers own(field, n);
    own.differentiate(FieldState(machine, state).input());
    const Matrix &by_q = own.by_q, &by_qd = own.by_qd;
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
