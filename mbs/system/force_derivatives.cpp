// Stiffness and damping of the forces.
#include "mbs/base/borrowed.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/kernels/path_twists.hpp"
#include "mbs/system/forces.hpp"

namespace cardan {

namespace {

// Central differences of a force, at a workspace of its own: the caller's kinematics must stay valid.
// @param add  the force: add(at, Q)
template <class Add>
void difference(const Add& add, const StateView& at, MatrixOut by_q, MatrixOut by_qd) {
    constexpr double step = 1e-6;
    const Eigen::Index n = at.q.size();
    const Model& model = at.kinematics.model();
    Workspace own(model);
    State moved = at.state();
    const auto force = [&](double& value, double change) {
        const double middle = value;
        value += change;
        Vector Q = Vector::Zero(n);
        add({moved, kinematics(model, moved.q, own)}, Q);
        value = middle;
        return Q;
    };
    for (Eigen::Index j = 0; j < n; ++j) {
        by_q.col(j) = (force(moved.q(j), step) - force(moved.q(j), -step)) / (2 * step);
        by_qd.col(j) = (force(moved.qd(j), step) - force(moved.qd(j), -step)) / (2 * step);
    }
}

struct Derivatives {
    Matrix by_q, by_qd;
};

// Subtracts factor times the derivatives of a force; its own, or central differences.
// @param add  the force: add(at, Q)
// @param at   as the derivatives take it
template <class Jacobian, class Add, class Input>
void subtract(const Jacobian& jacobian, const Add& add, double factor, const Input& at, Matrix& stiffness,
              Matrix& damping) {
    if (jacobian && factor == 1) {
        // It adds dQ/dq where -dQ/dq is gathered; changes of sign are exact.
        stiffness *= -1;
        damping *= -1;
        jacobian(at, stiffness, damping);
        stiffness *= -1;
        damping *= -1;
        return;
    }
    const Eigen::Index n = at.q.size();
    Borrowed<Derivatives> own;
    own->by_q.setZero(n, n);
    own->by_qd.setZero(n, n);
    if (jacobian)
        jacobian(at, own->by_q, own->by_qd);
    else
        difference(add, at, own->by_q, own->by_qd);
    stiffness -= factor * own->by_q;
    damping -= factor * own->by_qd;
}

}  // namespace

// d_b (v_a(C)) = e_b x v_a(C) for b <= a: the subtree of the more distal coordinate turns as one body.
void Forces::gravity_stiffness(const Kinematics& kin, Matrix& K) const {
    composites(kin);
    for (int a = 0; a < kin.model().size(); ++a) {
        const Workspace::Inertia& subtree = entry(kin.workspace().composite, a);
        const Vec3 C = subtree.C.vector(), lift = own_twist_at(kin, a, C).v;
        for (int b = a; b >= 0; b = own_parent(kin.model(), b)) {
            const Vec3 w = own_twist_at(kin, b, C).w;
            const double dQ = subtree.M * gravity_.dot(cross<double>(w, lift));
            K(a, b) -= dQ;
            if (b != a) K(b, a) -= dQ;
        }
    }
}

void Forces::wrench_stiffness(const FrameLoad& load, const Kinematics& kin, double time, Matrix& K) const {
    const Pose<double> at = pose(kin, load.frame);
    const bool follower = load.axes == WrenchAxes::frame;
    const auto [force, moment] = at_frame(load, kin, time);
    const Model& model = kin.model();
    const int tip = model.frame(load.frame).body;
    // The force turns with a follower's frame, and the twist of a turns with coordinate b if b is proximal to a; where
    // both do, nothing changes. If it is distal, its velocity moves the point.
    for (int a = tip; a >= 0; a = own_parent(model, a)) {
        const PointTwist<double> ta = own_twist_at(kin, a, at.p);
        const Vec3 turned = cross<double>(ta.v, force) + cross<double>(ta.w, moment),
                   moved = cross<double>(force, ta.w);
        for (int b = tip; b >= 0; b = own_parent(model, b)) {
            const PointTwist<double> tb = own_twist_at(kin, b, at.p);
            double dQ = b > a ? moved.dot(tb.v) : 0;
            if (follower == (b > a)) dQ += (follower ? -1 : 1) * turned.dot(tb.w);
            K(a, b) -= dQ;
        }
    }
}

void Forces::user_derivatives(const User& user, const StateView& at, ForceDerivatives& out) const {
    subtract(user.own.jacobian, user.own.force, user.factor, at, user.own.elastic ? out.elastic : out.loads,
             out.damping);
}

void Forces::field_derivatives(const Field& field, const StateView& at, ForceDerivatives& out) const {
    Vector none;
    const auto add = [&](const StateView& input, VectorOut Q) { add_field(field, 1, field.input(input), Q, none); };
    subtract(field.own.jacobian, add, field.factor, field.input(at), field.own.elastic ? out.elastic : out.loads,
             out.damping);
}

namespace {

// Memory of the derivatives of a field with states.
struct FieldMemory {
    Matrix Q_q, Q_qd, Q_s;
};

// Central differences of forces and rates, one after the other.
// @param evaluate  evaluate(at, out): Q, then f
template <class Evaluate>
void difference_field(const Evaluate& evaluate, const FieldInput& at, const std::vector<StateInfo>& states,
                      FieldJacobian& out) {
    constexpr double step = 1e-6;
    const Eigen::Index n = at.q.size(), m = at.own.size();
    Workspace workspace(at.kinematics.model());
    State moved = at.state();
    Vector s = at.own;
    const auto values = [&](double& value, double change) {
        const double middle = value;
        value += change;
        Vector all = Vector::Zero(n + m);
        const StateView now(moved, kinematics(at.kinematics.model(), moved.q, workspace));
        evaluate(FieldInput(now, s, at.own_inputs), all);
        value = middle;
        return all;
    };
    const auto add = [&](double& value, double h, auto Q, auto f) {
        const Vector slope = (values(value, h) - values(value, -h)) / (2 * h);
        Q += slope.head(n);
        f += slope.tail(m);
    };
    for (Eigen::Index j = 0; j < n; ++j) {
        add(moved.q(j), step, out.Q_q.col(j), out.f_q.col(j));
        add(moved.qd(j), step, out.Q_qd.col(j), out.f_qd.col(j));
    }
    for (Eigen::Index j = 0; j < m; ++j) add(s(j), step * entry(states, j).scale, out.Q_s.col(j), out.f_s.col(j));
}

}  // namespace

void Forces::state_field_derivatives(const Field& field, const StateView& at, ForceDerivatives& out) const {
    StateDerivatives& states = out.states;
    const Eigen::Index n = at.q.size(), m = field.states(), first = field.first;
    Borrowed<FieldMemory> own;
    own->Q_q.setZero(n, n);
    own->Q_qd.setZero(n, n);
    own->Q_s.setZero(n, m);
    FieldJacobian J{own->Q_q,
                    own->Q_qd,
                    own->Q_s,
                    states.f_q.middleRows(first, m),
                    states.f_qd.middleRows(first, m),
                    states.f_s.block(first, first, m, m)};
    if (field.own.state_jacobian)
        field.own.state_jacobian(field.input(at), J);
    else
        difference_field(
            [&](const FieldInput& input, Vector& all) {
                VectorOut Q = all.head(n);
                add_field(field, 1, input, Q, all.tail(m));
            },
            field.input(at), field.own.states, J);
    out.loads -= field.factor * own->Q_q;
    out.damping -= field.factor * own->Q_qd;
    states.Q_s.middleCols(first, m) += field.factor * own->Q_s;
}

// Central differences.
void Forces::input_derivatives(const Field& field, const StateView& at, StateDerivatives& out) const {
    constexpr double step = 1e-4;
    const Eigen::Index n = at.q.size(), m = field.states();
    State moved = at.state();
    const auto values = [&](int input, double change) {
        moved.u(input) = at.u(input) + change;
        Vector all = Vector::Zero(n + m);
        VectorOut Q = all.head(n);
        add_field(field, field.factor, field.input({moved, at.kinematics}), Q, all.tail(m));
        moved.u(input) = at.u(input);
        return all;
    };
    for (const int input : field.inputs) {
        const double h = step * inputs()[input].scale;
        const Vector slope = (values(input, h) - values(input, -h)) / (2 * h);
        out.Q_u.col(input) += slope.head(n);
        out.f_u.col(input).segment(field.first, m) += slope.tail(m);
    }
}

void Forces::derivatives(const StateView& at, ForceDerivatives& out) const {
    const Kinematics& kin = at.kinematics;
    require_state<double>(kin, at.q, at.qd);
    const Eigen::Index n = at.q.size();
    for (Matrix* m : {&out.elastic, &out.gravity, &out.loads, &out.damping}) m->setZero(n, n);
    for (const Law& law : laws_)
        for (Eigen::Index i = 0; i < law.K.rows(); ++i)
            for (Eigen::Index j = 0; j < law.K.cols(); ++j) {
                out.elastic(entry(law.at, i), entry(law.at, j)) += law.K(i, j);
                out.damping(entry(law.at, i), entry(law.at, j)) += law.D(i, j);
            }
    if (has_gravity()) gravity_stiffness(kin, out.gravity);
    for (const FrameLoad& load : loads_) wrench_stiffness(load, kin, at.time, out.loads);
    for (const User& user : users_) user_derivatives(user, at, out);
    for (const Field& field : fields_)
        if (field.states() == 0) field_derivatives(field, at, out);
    states_.derivatives(at, out.loads, out.damping, out.states);
    for (const Field& field : fields_)
        if (field.states() > 0) state_field_derivatives(field, at, out);
    for (const Field& field : fields_) input_derivatives(field, at, out.states);
}

}  // namespace cardan
