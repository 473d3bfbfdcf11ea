/// @file
/// A motion as channels and controllers see it.
#pragma once

#include "mbs/system/joint_loads.hpp"

#include <optional>

namespace cardan {

/// A state with its accelerations, kinematics and forces; the loads of the joints are computed when they are asked for.
/// Refers to all it is made of, which must live longer. Not for several threads at once.
class DynamicView : public StateView {
public:
    /// @param acting  the forces
    /// @param loops   whose multipliers are DynamicState::lambda
    DynamicView(const DynamicState& state CARDAN_LIFETIME_BOUND, const Kinematics& kin,
                const Forces& acting CARDAN_LIFETIME_BOUND, const Loops& loops CARDAN_LIFETIME_BOUND)
        : StateView(state, kin),
          qdd(state.qdd),
          s_rate(state.s_rate),
          actuator(state.actuator),
          lambda(state.lambda),
          forces(acting),
          loops_(&loops) {}

    /// Motion and joint loads of all bodies. The first call computes them.
    const JointLoads& loads() const;

    const Vector &qdd, &s_rate, &actuator, &lambda;  ///< as in DynamicState
    const Forces& forces;

private:
    const Loops* loops_;
    mutable std::optional<JointLoads> loads_;
};

}  // namespace cardan
