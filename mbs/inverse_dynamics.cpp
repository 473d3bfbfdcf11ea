#include "mbs/dynamics.hpp"

namespace cardan {

namespace {

// Newton-Euler in base axes; w, al: angular velocity and acceleration of the body, a: acceleration of its joint origin,
// F, N: force and moment about the joint origin transmitted by the joint.
template <class S>
void forward_sweep(const KinematicsT<S>& kin, VectorInT<S> qd, VectorInT<S> qdd) {
    WorkspaceT<S>& ws = kin.workspace();
    const Model& model = kin.model();
    for (int k = 0; k < model.size(); ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Model::Body& body = model.body(k);
        Vec3T<S>&w = ws.w[i], &al = ws.al[i], &a = ws.a[i];
        if (body.parent < 0) {
            w.setZero(), al.setZero(), a.setZero();
        } else {
            const std::size_t p = static_cast<std::size_t>(body.parent);
            const Vec3T<S> arm = ws.o[i] - ws.o[p];
            w = ws.w[p];
            al = ws.al[p];
            a = ws.a[p] + cross<S>(al, arm) + cross<S>(w, cross<S>(w, arm));
        }
        const Vec3T<S> rate = ws.e[i] * qd(k);
        if (body.revolute) {
            al += ws.e[i] * qdd(k) + cross<S>(w, rate);
            w += rate;
        } else {
            a += ws.e[i] * qdd(k) + S(2) * cross<S>(w, rate);
        }
        if (body.inertia.is_massless()) {
            ws.F[i].setZero();
            ws.N[i].setZero();
            continue;
        }
        const Vec3T<S> c = ws.r[i] - ws.o[i];
        ws.F[i] = S(body.inertia.mass) * (a + cross<S>(al, c) + cross<S>(w, cross<S>(w, c)));
        const Mat3T<S>& E = ws.E[i];
        const Mat3T<S> J = body.J.template cast<S>();
        const Vec3T<S> w_body = E.transpose() * w, al_body = E.transpose() * al, Jw = J * w_body;
        ws.N[i] = E * (J * al_body + cross<S>(w_body, Jw)) + cross<S>(c, ws.F[i]);
    }
}

}  // namespace

template <class S>
void inverse_dynamics(const KinematicsT<S>& kin, VectorInT<S> qd, VectorInT<S> qdd, VectorOutT<S> tau) {
    forward_sweep<S>(kin, qd, qdd);
    WorkspaceT<S>& ws = kin.workspace();
    const Model& model = kin.model();
    for (int k = model.size() - 1; k >= 0; --k) {
        const std::size_t i = static_cast<std::size_t>(k);
        tau(k) = dot<S>(ws.e[i], model.body(k).revolute ? ws.N[i] : ws.F[i]);
        if (model.body(k).parent < 0) continue;
        const std::size_t p = static_cast<std::size_t>(model.body(k).parent);
        ws.F[p] += ws.F[i];
        ws.N[p] += ws.N[i] + cross<S>(ws.o[i] - ws.o[p], ws.F[i]);
    }
    for (const Model::Spin& armature : model.armatures()) {
        S spin(0);
        for (const auto& [a, s] : armature.spin) spin += s * qdd(a);
        for (const auto& [a, s] : armature.spin) tau(a) += armature.inertia * s * spin;
    }
}

template <class S>
void inertial_forces(const KinematicsT<S>& kin, VectorInT<S> qd, VectorOutT<S> h) {
    inverse_dynamics<S>(kin, qd, kin.workspace().zero, h);
}

#define CARDAN_INSTANTIATE(S)                                                                            \
    template void inverse_dynamics<S>(const KinematicsT<S>&, VectorInT<S>, VectorInT<S>, VectorOutT<S>); \
    template void inertial_forces<S>(const KinematicsT<S>&, VectorInT<S>, VectorOutT<S>);
CARDAN_INSTANTIATE(double)
CARDAN_INSTANTIATE(Complex)
#undef CARDAN_INSTANTIATE

}  // namespace cardan
