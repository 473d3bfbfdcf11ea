/// @file
/// Elements with states of first order: electric machines, actuators, filters, controllers, springs that creep.
#pragma once

#include "mbs/system/states.hpp"

#include <functional>
#include <string>
#include <vector>

namespace cardan {

/// What an element with states sees: the values of what it has named, in its own order.
struct StateInput {
    double time;
    Eigen::Ref<const Vector> q, qd;   ///< of its coordinates
    Eigen::Ref<const Vector> s;       ///< its own states
    Eigen::Ref<const Vector> others;  ///< the states of other elements that it reads
    Eigen::Ref<const Vector> u;       ///< its inputs
};

/// Derivatives of what an element returns: rows of Q its coordinates, rows of f its own states; columns as in
/// StateInput.
struct StateJacobian {
    MatrixOut Q_q, Q_qd, Q_s, Q_others, Q_u;
    MatrixOut f_q, f_qd, f_s, f_others, f_u;
};

/// Energy in an element with states. d stored/dt = supplied - dissipated - Q . qd.
struct StatePower {
    double stored = 0;      ///< J
    double supplied = 0;    ///< from outside, W: by a grid, by the drive of an actuator
    double dissipated = 0;  ///< W, >= 0
};
/// The same of several elements, with the power of their forces.
struct StateEnergy : StatePower {
    double work = 0;  ///< Q . qd, W
};

/// Equations of first order ds/dt = f(t, q, qd, s, u) beside those of motion, and forces Q(t, q, qd, s, u) on
/// coordinates. The functions see nothing but what the element names, so that the library knows the pattern of the
/// derivatives; called from several threads, they keep nothing.
///
///     StateElement maxwell{.name = "bushing",
///                          .states = {{.name = "bushing force", .unit = "N", .scale = 100}},
///                          .coordinates = {body}};
///     maxwell.rates = [k, c](const StateInput& in, VectorOut Q, VectorOut f) {
///         f(0) = k * in.qd(0) - k / c * in.s(0);
///         Q(0) = -in.s(0);
///     };
struct StateElement {
    std::string name;
    std::vector<StateInfo> states = {};
    std::vector<BodyId> coordinates = {};  ///< those that it sees and acts upon
    std::vector<std::string> reads = {};   ///< names of states of other elements
    std::vector<std::string> inputs = {};  ///< names of inputs
    /// Q and f, zero before; the library adds Q to the other forces.
    std::function<void(const StateInput&, VectorOut Q, VectorOut f)> rates = {};
    /// Their exact derivatives, zero before. Empty: central differences with 1e-6 rad, m, rad/s, m/s, and 1e-6 of the
    /// scale of a state or an input, to some nine digits.
    std::function<void(const StateInput&, StateJacobian&)> jacobian = {};
    /// Empty: the element does not take part in the balance of energy beyond the work of Q.
    std::function<StatePower(const StateInput&)> power = {};
    /// Times, s, across which rates or forces are not smooth: integration restarts there.
    std::vector<double> breaks = {};
};

/// Derivatives of the states' part of a system, by all coordinates and states; those of Q by q and qd are with the
/// other forces (ForceDerivatives).
struct StateDerivatives {
    Matrix Q_s;        ///< n x m
    Matrix f_q, f_qd;  ///< m x n
    Matrix f_s;        ///< m x m
    Matrix Q_u, f_u;   ///< n x number of inputs, m x number of inputs
};

}  // namespace cardan
