/// @file
/// Added mass in the kernels: after their loops over all bodies they pass over the few whose subtrees carry it, with
/// inertias of six rows and columns. Twists and forces are [angular; linear] in base axes.
#pragma once

#include "mbs/kernels/registers/path_twists.hpp"

namespace cardan {

/// Added mass of a body alone about its joint origin, base axes.
template <class S>
Mat6T<S> own_added_mass(const KinematicsT<S>& kin, const Model::AddedMass& water) {
    Mat6T<S> turn = Mat6T<S>::Zero();
    turn.template topLeftCorner<3, 3>() = turn.template bottomRightCorner<3, 3>() =
        entry(kin.arrays().frame, water.body).E.matrix();
    return turn * water.inertia.template cast<S>() * turn.transpose();
}

/// Sums the added mass of the subtrees, tip to base.
template <class S>
void gather_added_mass(const KinematicsT<S>& kin);

/// own_twist_at() as one column.
template <class S>
Vec6T<S> twist_column(const KinematicsT<S>& kin, int a, const Vec3T<S>& C) {
    const PointTwist<S> twist = own_twist_at(kin, a, C);
    return (Vec6T<S>() << twist.w, twist.v).finished();
}

/// Sum of products, without conjugation.
template <class S>
S work(const Vec6T<S>& twist, const Vec6T<S>& force) {
    return (twist.transpose() * force).value();
}

/// v x* f: rate of a momentum or a force f that moves with the twist v.
template <class S>
Vec6T<S> carried(const Vec6T<S>& v, const Vec6T<S>& f) {
    const Vec3T<S> w = v.template head<3>(), u = v.template tail<3>(), moment = f.template head<3>(),
                   force = f.template tail<3>();
    return (Vec6T<S>() << cross<S>(w, moment) + cross<S>(u, force), cross<S>(w, force)).finished();
}

/// B of a body with the twist v: S_a . B S_b summed over the bodies is Gamma_abc qd^c,
///
///     B = (v x* I - I v x + (I v) x*) / 2,      (f x*) y = y x* f.                [Echeandia and Wensing 2021, eq. 18]
///
/// Linear in v; it does not ask that I be rigid.
template <class S>
Mat6T<S> coriolis_inertia(const Mat6T<S>& I, const Vec6T<S>& v) {
    Mat6T<S> across = Mat6T<S>::Zero();  // v x
    across.template topLeftCorner<3, 3>() = across.template bottomRightCorner<3, 3>() = skew<S>(v.template head<3>());
    across.template bottomLeftCorner<3, 3>() = skew<S>(v.template tail<3>());
    const Vec6T<S> momentum = I * v;
    Mat6T<S> B = -across.transpose() * I - I * across;
    B.template topLeftCorner<3, 3>() -= skew<S>(momentum.template head<3>());
    B.template topRightCorner<3, 3>() -= skew<S>(momentum.template tail<3>());
    B.template bottomLeftCorner<3, 3>() -= skew<S>(momentum.template tail<3>());
    return B / S(2);
}

/// Twist of the joint origin of a body, and its rate in the axes of the body, from what a recursion found.
template <class S>
Vec6T<S> twist_column(const typename KernelArraysT<S>::Motion& motion) {
    return (Vec6T<S>() << motion.w.vector(), motion.v.vector()).finished();
}
template <class S>
Vec6T<S> rate_column(const typename KernelArraysT<S>::Motion& motion) {
    return (Vec6T<S>() << motion.al.vector(), (motion.a - cross(motion.w, motion.v)).vector()).finished();
}

/// Force of the water that a body entrains, I a + v x* I v (Kirchhoff).
template <class S>
Vec6T<S> added_mass_force(const Mat6T<S>& I, const typename KernelArraysT<S>::Motion& motion) {
    const Vec6T<S> v = twist_column<S>(motion);
    return I * rate_column<S>(motion) + carried<S>(v, I * v);
}

}  // namespace cardan
