/// @file
/// The recursions as a textbook writes them: plain twins of the kernels, to be read beside them and to check them.
///
/// Twists and wrenches are columns of six numbers, [angular; linear], in the axes of their own body; transformations
/// and inertias are 6 x 6 matrices. The kernels in mbs/kernels work in base axes, with vectors of three numbers in
/// registers and without velocity terms in the articulated-body sweep. Nothing here is fast: it allocates, and
/// multiplies zeros.
///                                                    [Featherstone, Rigid Body Dynamics Algorithms, 2008; his letters]
#pragma once

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/model/model.hpp"
#include "tests/support/numbers.hpp"

#include <vector>

namespace cardan::testing::plain {

using std::cos;
using std::sin;

// ---- Spatial vectors ------------------------------------------------------------------------------------------------

/// Motion transform from parent to body axes: E turns components into body axes, r is the body's origin in the parent.
///                                                                                                        [section 2.8]
template <class S>
Mat6T<S> motion_transform(const Mat3T<S>& E, const Vec3T<S>& r) {
    Mat6T<S> X = Mat6T<S>::Zero();
    X.topLeftCorner(3, 3) = X.bottomRightCorner(3, 3) = E;
    X.bottomLeftCorner(3, 3) = -E * skew<S>(r);
    return X;
}

/// v x: what a body with twist v does to a twist that moves with it.                                      [section 2.9]
template <class S>
Mat6T<S> cross_motion(const Vec6T<S>& v) {
    Mat6T<S> m = Mat6T<S>::Zero();
    m.topLeftCorner(3, 3) = m.bottomRightCorner(3, 3) = skew<S>(v.head(3));
    m.bottomLeftCorner(3, 3) = skew<S>(v.tail(3));
    return m;
}

/// v x*: likewise to a wrench or a momentum.                                                              [section 2.9]
template <class S>
Mat6T<S> cross_force(const Vec6T<S>& v) {
    return -cross_motion<S>(v).transpose();
}

/// Inertia about the origin of the body's frame.                                                         [section 2.13]
template <class S>
Mat6T<S> spatial_inertia(const RigidInertia& body) {
    const Mat3 c = skew<double>(body.com);
    Mat6 I;
    I << body.J + body.mass * c * c.transpose(), body.mass * c, body.mass * c.transpose(), body.mass * Mat3::Identity();
    return I.cast<S>();
}

// ---- One joint ------------------------------------------------------------------------------------------------------

/// What joint i is at q, and what body it carries.
template <class S>
struct Joint {
    Mat6T<S> X;     ///< motion transform from the parent's to its own axes
    Vec6T<S> axis;  ///< S: twist per rate, along or about z
    Mat6T<S> I;     ///< inertia of the body alone
};

/// jcalc and X_J X_T of the tables.                                                            [section 4.4, table 4.1]
template <class S>
Joint<S> joint(const Model::Body& body, const S& q) {
    Mat3T<S> turn = Mat3T<S>::Identity();  // body axes at q -> body axes at q = 0
    Vec3T<S> shift = Vec3T<S>::Zero();
    if (body.revolute)
        turn.topLeftCorner(2, 2) << cos(q), -sin(q), sin(q), cos(q);
    else
        shift(2) = q;
    const Mat3T<S> R = body.joint.R.cast<S>();
    const Vec3T<S> r = body.joint.p.cast<S>() + R * shift;
    return {motion_transform<S>((R * turn).transpose(), r), Vec6T<S>::Unit(body.revolute ? 2 : 5),
            spatial_inertia<S>(body.inertia)};
}

template <class S>
std::vector<Joint<S>> joints(const Model& model, const VectorT<S>& q) {
    std::vector<Joint<S>> all;
    for (int i = 0; i < model.size(); ++i) all.push_back(joint<S>(model.body(i), q(i)));
    for (const Model::AddedMass& water : model.added_masses()) entry(all, water.body).I += water.inertia.cast<S>();
    return all;
}

/// One column per body, and the value of its parent: zero at the base.
template <class S>
using Columns = Eigen::Matrix<S, 6, Eigen::Dynamic>;
template <class S>
Vec6T<S> of_parent(const Columns<S>& x, int parent) {
    if (parent < 0) return Vec6T<S>::Zero();
    return x.col(parent);
}

// ---- Armatures ------------------------------------------------------------------------------------------------------

/// The part of the metric that armatures add: sum of J s s^T.
inline Matrix armature_metric(const Model& model) {
    Matrix g = Matrix::Zero(model.size(), model.size());
    for (const Model::Spin& armature : model.armatures())
        for (const auto& [a, sa] : armature.spin)
            for (const auto& [b, sb] : armature.spin) g(a, b) += armature.inertia * sa * sb;
    return g;
}

// ---- Inverse dynamics -----------------------------------------------------------------------------------------------

/// Recursive Newton-Euler algorithm: forces tau of the joints for the accelerations qdd, without gravity.   [table 5.1]
template <class S>
VectorT<S> inverse_dynamics(const Model& model, const VectorT<S>& q, const VectorT<S>& qd, const VectorT<S>& qdd) {
    const int n = model.size();
    const auto tree = joints<S>(model, q);
    Columns<S> v(6, n), a(6, n), f(6, n);
    for (int i = 0; i < n; ++i) {
        const auto& [X, axis, I] = entry(tree, i);
        const int parent = model.body(i).parent;
        const Vec6T<S> v_joint = axis * qd(i);
        v.col(i) = X * of_parent<S>(v, parent) + v_joint;
        a.col(i) = X * of_parent<S>(a, parent) + axis * qdd(i) + cross_motion<S>(v.col(i)) * v_joint;
        f.col(i) = I * a.col(i) + cross_force<S>(v.col(i)) * (I * v.col(i));
    }
    VectorT<S> tau = armature_metric(model).cast<S>() * qdd;
    for (int i = n - 1; i >= 0; --i) {
        const auto& [X, axis, I] = entry(tree, i);
        const int parent = model.body(i).parent;
        tau(i) += (axis.transpose() * f.col(i)).value();
        if (parent >= 0) f.col(parent) += X.transpose() * f.col(i);
    }
    return tau;
}

/// The metric, column by column: forces for a unit acceleration from rest.                                  [chapter 6]
template <class S>
MatrixT<S> metric(const Model& model, const VectorT<S>& q) {
    const int n = model.size();
    const VectorT<S> rest = VectorT<S>::Zero(n);
    MatrixT<S> g(n, n);
    for (int b = 0; b < n; ++b) g.col(b) = inverse_dynamics<S>(model, q, rest, VectorT<S>::Unit(n, b));
    return g;
}

// ---- Forward dynamics -----------------------------------------------------------------------------------------------

template <class S>
struct Motion {
    VectorT<S> qdd;
    VectorT<S> actuator;  ///< what drives add to Q on driven coordinates; zero on free ones
};

/// Articulated-body algorithm, one function per pass; the arrays keep the table's letters.
///                                                                                [table 7.1; driven joints: chapter 9]
///
/// An armature on one coordinate only stands beside the pivot D. One on several couples joints, which no articulated
/// inertia can express: for those there is forward_dynamics_by_metric(). (ForwardDynamics corrects by a low rank.)
template <class S>
struct ArticulatedBody {
    const Model& model;
    std::vector<Joint<S>> tree;
    Columns<S> v, c, pA, U, a;
    std::vector<Mat6T<S>> IA;  ///< of the subtree whose free joints yield
    VectorT<S> D, u;

    ArticulatedBody(const Model& m, const VectorT<S>& q) : model(m), tree(joints<S>(m, q)) {
        const int n = m.size();
        for (Columns<S>* x : {&v, &c, &pA, &U, &a}) x->setZero(6, n);
        for (VectorT<S>* x : {&D, &u}) x->setZero(n);
    }

    /// Velocities, and the bodies alone.
    void first_pass(const VectorT<S>& qd) {
        for (int i = 0; i < model.size(); ++i) {
            const auto& [X, axis, I] = entry(tree, i);
            const Vec6T<S> v_joint = axis * qd(i);
            v.col(i) = X * of_parent<S>(v, model.body(i).parent) + v_joint;
            c.col(i) = cross_motion<S>(v.col(i)) * v_joint;
            pA.col(i) = cross_force<S>(v.col(i)) * (I * v.col(i));
            IA.push_back(I);
        }
    }

    /// Articulated inertias and bias forces, tips to base. A driven joint does not yield: it hands on the whole
    /// inertia.
    void second_pass(const std::vector<bool>& driven, const VectorT<S>& Q, const VectorT<S>& qdd) {
        const Vector armature = armature_metric(model).diagonal();
        for (int i = model.size() - 1; i >= 0; --i) {
            const auto& [X, axis, I] = entry(tree, i);
            Mat6T<S> Ia = entry(IA, i);
            U.col(i) = Ia * axis;
            D(i) = (axis.transpose() * U.col(i)).value() + armature(i);
            u(i) = Q(i) - (axis.transpose() * pA.col(i)).value();
            const bool held = entry(driven, i);
            if (!held) Ia -= U.col(i) * U.col(i).transpose() / D(i);
            const Vec6T<S> pa = pA.col(i) + Ia * c.col(i) + U.col(i) * (held ? qdd(i) : S(u(i) / D(i)));
            const int parent = model.body(i).parent;
            if (parent < 0) continue;
            entry(IA, parent) += X.transpose() * Ia * X;
            pA.col(parent) += X.transpose() * pa;
        }
    }

    /// Accelerations, base to tips.
    Motion<S> third_pass(const std::vector<bool>& driven, VectorT<S> qdd) {
        VectorT<S> actuator = VectorT<S>::Zero(model.size());
        for (int i = 0; i < model.size(); ++i) {
            const auto& [X, axis, I] = entry(tree, i);
            a.col(i) = X * of_parent<S>(a, model.body(i).parent) + c.col(i);
            const S load = u(i) - (U.col(i).transpose() * a.col(i)).value();
            if (entry(driven, i))
                actuator(i) = D(i) * qdd(i) - load;
            else
                qdd(i) = load / D(i);
            a.col(i) += axis * qdd(i);
        }
        return {qdd, actuator};
    }
};

/// Accelerations of the free joints for the forces Q, by the articulated-body algorithm.
/// @param qdd  accelerations of driven joints; others are not read
/// @throws InputError if an armature spans several coordinates
template <class S>
Motion<S> forward_dynamics(const Model& model, const std::vector<bool>& driven, const VectorT<S>& q,
                           const VectorT<S>& qd, const VectorT<S>& Q, const VectorT<S>& qdd) {
    for (const Model::Spin& armature : model.armatures())
        if (armature.spin.size() > 1)
            throw InputError("plain forward dynamics", armature.name, armature.spin.size(), "one coordinate");
    ArticulatedBody<S> algorithm(model, q);
    algorithm.first_pass(qd);
    algorithm.second_pass(driven, Q, qdd);
    return algorithm.third_pass(driven, qdd);
}

/// Likewise with any armatures: g_ff qdd_f = Q_f - tau_f, where tau are the forces at qdd_f = 0, by dense elimination.
template <class S>
Motion<S> forward_dynamics_by_metric(const Model& model, const std::vector<bool>& driven, const VectorT<S>& q,
                                     const VectorT<S>& qd, const VectorT<S>& Q, VectorT<S> qdd) {
    const int n = model.size();
    std::vector<int> free;
    for (int i = 0; i < n; ++i)
        if (!entry(driven, i)) free.push_back(i);
    for (const int i : free) qdd(i) = S(0);
    if (!free.empty()) {
        const VectorT<S> load = (Q - inverse_dynamics<S>(model, q, qd, qdd))(free);
        const MatrixT<S> g = metric<S>(model, q)(free, free);
        const VectorT<S> solved = g.partialPivLu().solve(load);
        qdd(free) = solved;
    }
    VectorT<S> actuator = inverse_dynamics<S>(model, q, qd, qdd) - Q;
    for (const int i : free) actuator(i) = S(0);
    return {qdd, actuator};
}

// ---- Derivatives ----------------------------------------------------------------------------------------------------

/// Jacobian of f by the complex step Im f(x + i h e_j) / h, exact to rounding.
///                          [Squire and Trapp, Using complex variables to estimate derivatives of real functions, 1998]
template <class Function>
Matrix jacobian(const Function& f, const Vector& x) {
    const Eigen::Index n = x.size();
    Matrix J(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
        ComplexVector moved = x.cast<Complex>();
        moved(j) += Complex(0, complex_step);
        J.col(j) = f(moved).imag() / complex_step;
    }
    return J;
}

}  // namespace cardan::testing::plain
