#include "mbs/kernels/lagrange.hpp"

#include "mbs/base/entry.hpp"

#include <algorithm>

namespace cardan::lagrange {

namespace {

// Twist [angular; linear] of coordinate a at the joint origin of a body with added mass, body axes.
template <class S>
Vec6T<S> twist(const KinematicsT<S>& kin, const Model::AddedMass& water, int a) {
    if (!kin.model().precedes(a, water.body)) return Vec6T<S>::Zero();
    const PointTwist<S> at = twist_at(kin, a, kin.origin(water.body));
    const Mat3T<S> to_body = kin.rotation(water.body).transpose();
    return (Vec6T<S>() << to_body * at.w, to_body * at.v).finished();
}

// x . A y
template <class S>
S energy_product(const Model::AddedMass& water, const Vec6T<S>& x, const Vec6T<S>& y) {
    return (x.transpose() * (water.inertia.template cast<S>() * y)).value();
}

// d/dq^c of the twist of a, seen from the body: it changes if c lies between a and the body.
template <class S>
Vec6T<S> twist_rate(const KinematicsT<S>& kin, const Model::AddedMass& water, int a, int c) {
    if (c <= a) return Vec6T<S>::Zero();
    const Vec6T<S> x = twist(kin, water, a), y = twist(kin, water, c);
    const Vec3T<S> xw = x.template head<3>(), xv = x.template tail<3>(), yw = y.template head<3>(),
                   yv = y.template tail<3>();
    return (Vec6T<S>() << cross<S>(xw, yw), cross<S>(xw, yv) + cross<S>(xv, yw)).finished();
}

// d_c g_ab of a body with added mass.
template <class S>
S metric_rate(const KinematicsT<S>& kin, const Model::AddedMass& water, int c, int a, int b) {
    return energy_product<S>(water, twist_rate(kin, water, a, c), twist(kin, water, b)) +
           energy_product<S>(water, twist_rate(kin, water, b, c), twist(kin, water, a));
}

}  // namespace

template <class S>
S metric(const KinematicsT<S>& kin, int a, int b) {
    const Model& model = kin.model();
    for (const int index : {a, b}) require_index("metric", "index", index, model.size());
    S sum(0);
    for (int k = std::max(a, b); k < model.size(); ++k) {
        const BasisFunctions<S> at_a = basis_functions(kin, k, a), at_b = basis_functions(kin, k, b);
        const Vec3T<S> J_Omega = model.body(k).J.template cast<S>() * at_b.Omega;
        sum += S(model.body(k).inertia.mass) * dot<S>(at_a.u, at_b.u) + dot<S>(at_a.Omega, J_Omega);
    }
    for (const Model::AddedMass& water : model.added_masses())
        sum += energy_product<S>(water, twist(kin, water, a), twist(kin, water, b));
    for (const Model::Spin& armature : model.armatures()) {
        double sa = 0, sb = 0;
        for (const auto& [index, factor] : armature.spin) {
            if (index == a) sa += factor;
            if (index == b) sb += factor;
        }
        sum += S(armature.inertia * sa * sb);
    }
    return sum;
}

template <class S>
S christoffel_first_kind(const KinematicsT<S>& kin, int a, int b, int c) {
    const Model& model = kin.model();
    for (const int index : {a, b, c}) require_index("Christoffel symbols", "index", index, model.size());
    if (b > c) std::swap(b, c);
    if (!model.precedes(b, c)) return S(0);
    S sum(0);
    for (int k = std::max(a, c); k < model.size(); ++k) {
        const BasisFunctions<S> at_a = basis_functions(kin, k, a), at_b = basis_functions(kin, k, b),
                                at_c = basis_functions(kin, k, c);
        if (!model.precedes(a, k) || !model.precedes(c, k)) continue;
        const Vec3T<S> P_Omega = binet_tensor<double>(model.body(k).J).template cast<S>() * at_b.Omega;
        sum += S(model.body(k).inertia.mass) * dot<S>(at_a.u, cross<S>(at_b.Omega, at_c.u)) +
               dot<S>(P_Omega, cross<S>(at_c.Omega, at_a.Omega));
    }
    for (const Model::AddedMass& water : model.added_masses()) {
        const auto by = [&](int i, int j, int k) { return metric_rate(kin, water, i, j, k); };
        sum += (by(c, a, b) + by(b, a, c) - by(a, b, c)) / S(2);
    }
    return sum;
}

double generalised_force(const Kinematics& kin, std::span<const BodyLoad> loads, int a) {
    require_count("generalised force", "loads", loads.size(), static_cast<std::size_t>(kin.model().size()));
    double sum = 0;
    for (int k = a; k < kin.model().body(a).subtree_end; ++k) {
        const BasisFunctions<double> basis = basis_functions(kin, k, a);
        const BodyLoad& load = entry(loads, k);
        sum += dot<double>(load.force, basis.u) + dot<double>(load.moment, basis.Omega);
    }
    return sum;
}

double left_hand_side(const Kinematics& kin, VectorIn qd, VectorIn qdd, int a) {
    const int n = kin.model().size();
    require_size("Lagrange's equations", "qd", qd, n);
    require_size("Lagrange's equations", "qdd", qdd, n);
    double sum = 0;
    for (int b = 0; b < n; ++b) {
        sum += metric(kin, a, b) * qdd(b);
        for (int c = 0; c < n; ++c) sum += christoffel_first_kind(kin, a, b, c) * qd(b) * qd(c);
    }
    return sum;
}

template double metric<double>(const KinematicsT<double>&, int, int);
template Complex metric<Complex>(const KinematicsT<Complex>&, int, int);
template double christoffel_first_kind<double>(const KinematicsT<double>&, int, int, int);
template Complex christoffel_first_kind<Complex>(const KinematicsT<Complex>&, int, int, int);

}  // namespace cardan::lagrange
