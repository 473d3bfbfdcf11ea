/// @file
/// The state of a system, and views of it with what follows from it.
#pragma once

#include "mbs/base/lifetime_bound.hpp"
#include "mbs/kernels/kinematics.hpp"

namespace cardan {

/// Position and velocity of a system at a time, the states of first order beside them, and its inputs. SI, radians.
struct State {
    double time = 0;
    Vector q = {}, qd = {};  ///< of all coordinates
    Vector s = {};           ///< Forces::states()
    Vector u = {};           ///< Forces::inputs()
};

/// A state with its accelerations and the forces that go with them.
///
/// In steady states and linearisations, `s` and `u` that are empty stand for the values of their tables; the others for
/// zero.
struct DynamicState : State {
    Vector qdd = {};
    Vector s_rate = {};    ///< ds/dt
    Vector actuator = {};  ///< generalised force of the drive on its coordinate, N m or N; zero on free ones
    Vector lambda = {};    ///< multipliers of the loops, Loops::equations()
};

/// A state at time 0 at position q, without motion.
inline DynamicState at_rest(const Vector& q) {
    const Vector zero = Vector::Zero(q.size());
    return {{.q = q, .qd = zero}, zero};
}
/// A state at the origin of n coordinates, without motion.
inline DynamicState at_rest(Eigen::Index n) {
    return at_rest(Vector(Vector::Zero(n)));
}

/// A state with its kinematics: what forces depend on. Refers to the state, which must live longer.
struct StateView {
    StateView(const State& state CARDAN_LIFETIME_BOUND, const Kinematics& kin)
        : time(state.time), q(state.q), qd(state.qd), s(state.s), u(state.u), kinematics(kin) {}

    /// A copy, to be changed.
    State state() const { return {time, q, qd, s, u}; }

    double time;
    const Vector &q, &qd, &s, &u;
    Kinematics kinematics;
};

}  // namespace cardan
