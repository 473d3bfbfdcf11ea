/// @file
/// Force elements: forces that depend on the motion, on states of first order and on inputs. Springs, actuators,
/// electric machines, filters, controllers, contact, air and water are made of them.
#pragma once

#include "mbs/model/tree.hpp"
#include "mbs/system/state.hpp"
#include "mbs/system/states.hpp"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace cardan {

/// Force and moment at a point, N and N m.
struct Wrench {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
};
/// Adds a wrench about `from` as one about `to`.
inline void add_moved(Wrench& sum, const Wrench& wrench, const Vec3& from, const Vec3& to, double factor = 1) {
    sum.force += factor * wrench.force;
    sum.moment += factor * (wrench.moment + cross<double>(from - to, wrench.force));
}

/// A point of a body at which an element acts.
struct FramePoint {
    FrameId frame = {};
    Vec3 place = Vec3::Zero();  ///< in the axes of the frame, m
};
/// Base axes, m.
Vec3 place_of(const Kinematics& kin, const FramePoint& point);

/// View that a force element has of a state: the values of what it names, in its own order.
struct ElementView {
    using Values = Eigen::Ref<const Vector>;
    ElementView(double now, const Values& position, const Values& rate, const Values& own, const Values& read,
                const Values& given, const StateView& whole CARDAN_LIFETIME_BOUND)
        : time(now), q(position), qd(rate), s(own), others(read), u(given), system(whole) {}
    /// View of an element with points, without states and inputs.
    ElementView(const StateView& at CARDAN_LIFETIME_BOUND)  // NOLINT(google-explicit-constructor)
        : ElementView(at.time, at.q, at.qd, at.s.head(0), at.s.head(0), at.u.head(0), at) {}

    double time;              ///< s
    Values q, qd;             ///< of its coordinates; of an element with points, of all
    Values s;                 ///< its own states
    Values others;            ///< the states of other elements that it reads
    Values u;                 ///< its inputs
    const StateView& system;  ///< the whole, with its kinematics: for elements with points only
};

/// Answer of an element, all of it zero when it is asked.
struct ElementForces {
    VectorOut Q;                 ///< generalised forces on its coordinates, in the order of ElementView::q
    VectorOut f;                 ///< ds/dt of its states
    std::span<Wrench> wrenches;  ///< about each of its points, base axes
};

/// Derivatives of what an element answers: rows of Q the coordinates of ElementView::q, rows of f its own states;
/// columns as in ElementView. The wrenches count with the generalised forces that they make.
struct ElementJacobian {
    MatrixOut Q_q, Q_qd, Q_s, Q_others, Q_u;
    MatrixOut f_q, f_qd, f_s, f_others, f_u;
};

/// Energy of an element. d stored/dt = supplied - dissipated - Q . qd.
struct ElementPower {
    double stored = 0;      ///< J
    double supplied = 0;    ///< from outside, W: by a grid, by the drive of an actuator
    double dissipated = 0;  ///< W, >= 0
};

/// States of an element that depend on one another, and the coordinates that they see or act upon; what other groups do
/// reaches them through coordinates only.
struct ElementGroup {
    std::vector<int> states = {};  ///< indices in the element
    std::vector<BodyId> coordinates = {};
};

/// Generalised forces Q(t, q, qd, s, u), or wrenches, and equations ds/dt = f(t, q, qd, s, u) beside those of motion.
///
/// An element either names the coordinates that it sees and acts upon, or the points at which it acts; then it sees the
/// whole system, and loads of joints and channels take its wrenches into account. The functions depend on nothing but
/// what they see, so that the library knows the pattern of the derivatives; called from several threads, they keep
/// nothing.
///
///     ForceElement maxwell{.name = "bushing",
///                          .states = {{.name = "bushing force", .unit = "N", .scale = 100}},
///                          .coordinates = {body}};
///     maxwell.evaluate = [k, c](const ElementView& at, ElementForces& out) {
///         out.f(0) = k * at.qd(0) - k / c * at.s(0);
///         out.Q(0) = -at.s(0);
///     };
struct ForceElement {
    std::string name = {};
    std::vector<StateInfo> states = {};
    std::vector<BodyId> coordinates = {};
    std::vector<FramePoint> points = {};
    std::vector<std::string> reads = {};   ///< names of states of other elements
    std::vector<std::string> inputs = {};  ///< names of inputs of the system, ForceSet::add_input()

    std::function<void(const ElementView&, ElementForces&)> evaluate = {};
    /// Adds exact derivatives. Empty: central differences with 1e-6 rad, m, rad/s, m/s, and 1e-6 of the scale of a
    /// state or an input, to some nine digits; those of an element with points allocate.
    std::function<void(const ElementView&, ElementJacobian&)> jacobian = {};
    /// `jacobian` leaves out the derivatives by inputs: central differences with 1e-4 of their scale are added.
    bool differences_by_inputs = false;
    /// Potential energy, J, if the forces have one; what else they do counts as work of loads.
    std::function<double(const ElementView&)> potential = {};
    /// Whole balance of energy of the element, in the place of a potential. Empty: it has none beyond the work of Q.
    std::function<ElementPower(const ElementView&)> power = {};
    /// A spring rather than a load: -dQ/dq counts as elastic stiffness, and load factors leave it as it is.
    bool elastic = false;
    /// Times, s, ascending, across which it is not smooth: integration restarts there.
    std::vector<double> breaks = {};
    /// Groups of the states of an element with points, where not all of them depend on one another and on all
    /// coordinates: every state in one of them.
    std::vector<ElementGroup> groups = {};
};

/// Derivatives of the rates of the states, and of the forces by states and inputs.
struct StateDerivatives {
    Matrix Q_s;        ///< n x m
    Matrix f_q, f_qd;  ///< m x n
    Matrix f_s;        ///< m x m
    Matrix Q_u, f_u;   ///< n x number of inputs, m x number of inputs
};

}  // namespace cardan
