#include "mbs/derivatives.hpp"

namespace cardan {

namespace {

// v x m for motion vectors, [angular; linear] about the base origin.
template <class S>
Vec6T<S> cross_motion(const Vec6T<S>& v, const Vec6T<S>& m) {
    Vec6T<S> r;
    const Vec3T<S> w = v.template head<3>(), l = v.template tail<3>(), mw = m.template head<3>(),
                   ml = m.template tail<3>();
    r << cross<S>(w, mw), Vec3T<S>(cross<S>(w, ml) + cross<S>(l, mw));
    return r;
}

// v x* f for force vectors [moment; force].
template <class S>
Vec6T<S> cross_force(const Vec6T<S>& v, const Vec6T<S>& f) {
    Vec6T<S> r;
    const Vec3T<S> w = v.template head<3>(), l = v.template tail<3>(), n = f.template head<3>(),
                   F = f.template tail<3>();
    r << Vec3T<S>(cross<S>(w, n) + cross<S>(l, F)), cross<S>(w, F);
    return r;
}

// (v x* I - I v x + (I v) xbar*) / 2, where f xbar* is the matrix with (f xbar*) m = m x* f.
template <class S>
Mat6T<S> velocity_matrix(const Mat6T<S>& I, const Vec6T<S>& v, const Vec6T<S>& momentum) {
    Mat6T<S> crm = Mat6T<S>::Zero();
    crm.template topLeftCorner<3, 3>() = crm.template bottomRightCorner<3, 3>() = skew<S>(v.template head<3>());
    crm.template bottomLeftCorner<3, 3>() = skew<S>(v.template tail<3>());
    Mat6T<S> bar = Mat6T<S>::Zero();
    bar.template topLeftCorner<3, 3>() = -skew<S>(momentum.template head<3>());
    bar.template topRightCorner<3, 3>() = bar.template bottomLeftCorner<3, 3>() = -skew<S>(momentum.template tail<3>());
    return S(0.5) * (bar - crm.transpose() * I - I * crm);
}

template <class S>
Mat6T<S> inertia_about_base(const WorkspaceT<S>& ws, const Model::Body& body, std::size_t i) {
    const S m(body.inertia.mass);
    const Mat3T<S> r = skew<S>(ws.r[i]);
    Mat6T<S> I;
    I.template topLeftCorner<3, 3>() = ws.E[i] * body.J.template cast<S>() * ws.E[i].transpose() - m * (r * r);
    I.template topRightCorner<3, 3>() = m * r;
    I.template bottomLeftCorner<3, 3>() = -m * r;
    I.template bottomRightCorner<3, 3>() = m * Mat3T<S>::Identity();
    return I;
}

}  // namespace

template <class S>
void inverse_dynamics_derivatives(const KinematicsT<S>& kin, VectorInT<S> qd, VectorInT<S> qdd, MatrixOutT<S> dtau_dq,
                                  MatrixOutT<S> dtau_dqd) {
    WorkspaceT<S>& ws = kin.workspace();
    const Model& model = kin.model();
    dtau_dq.setZero();
    dtau_dqd.setZero();
    // U and c hold Psi' = v_parent x S and Psi'' = a_parent x S + v_parent x Psi'; pA the force of the subtree.
    for (int k = 0; k < model.size(); ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Model::Body& body = model.body(k);
        Vec6T<S>& axis = ws.S6[i];
        if (body.revolute)
            axis << ws.e[i], cross<S>(ws.o[i], ws.e[i]);
        else
            axis << Vec3T<S>::Zero(), ws.e[i];
        const bool root = body.parent < 0;
        const std::size_t p = root ? 0 : static_cast<std::size_t>(body.parent);
        const Vec6T<S> v_parent = root ? Vec6T<S>::Zero() : ws.V[p];
        const Vec6T<S> a_parent = root ? Vec6T<S>::Zero() : ws.A[p];
        ws.U[i] = cross_motion<S>(v_parent, axis);
        ws.c[i] = cross_motion<S>(a_parent, axis) + cross_motion<S>(v_parent, ws.U[i]);
        ws.V[i] = v_parent + axis * qd(k);
        ws.A[i] = a_parent + axis * qdd(k) + ws.U[i] * qd(k);
        ws.IA[i] = inertia_about_base(ws, body, i);
        const Vec6T<S> momentum = ws.IA[i] * ws.V[i];
        ws.B[i] = velocity_matrix<S>(ws.IA[i], ws.V[i], momentum);
        ws.pA[i] = ws.IA[i] * ws.A[i] + cross_force<S>(ws.V[i], momentum);
    }
    for (int k = model.size() - 1; k >= 0; --k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Vec6T<S>&axis = ws.S6[i], &Psi1 = ws.U[i], &Psi2 = ws.c[i];
        const Vec6T<S> by_q = S(2) * (ws.B[i] * Psi1) + ws.IA[i] * Psi2 + cross_force<S>(axis, ws.pA[i]);
        const Vec6T<S> by_qd = S(2) * (ws.B[i] * axis + ws.IA[i] * Psi1);
        const Vec6T<S> row_I = ws.IA[i] * axis, row_B = S(2) * (ws.B[i].transpose() * axis);
        for (int a = k; a >= 0; a = model.body(a).parent) {
            const std::size_t j = static_cast<std::size_t>(a);
            dtau_dq(k, a) = (row_B.transpose() * ws.U[j] + row_I.transpose() * ws.c[j])(0);
            dtau_dqd(k, a) = (row_B.transpose() * ws.S6[j])(0) + S(2) * (row_I.transpose() * ws.U[j])(0);
            if (a == k) continue;
            dtau_dq(a, k) = (ws.S6[j].transpose() * by_q)(0);
            dtau_dqd(a, k) = (ws.S6[j].transpose() * by_qd)(0);
        }
        if (model.body(k).parent < 0) continue;
        const std::size_t p = static_cast<std::size_t>(model.body(k).parent);
        ws.IA[p] += ws.IA[i];
        ws.B[p] += ws.B[i];
        ws.pA[p] += ws.pA[i];
    }
}

#define CARDAN_INSTANTIATE(S)                                                                                       \
    template void inverse_dynamics_derivatives<S>(const KinematicsT<S>&, VectorInT<S>, VectorInT<S>, MatrixOutT<S>, \
                                                  MatrixOutT<S>);
CARDAN_INSTANTIATE(double)
CARDAN_INSTANTIATE(Complex)
#undef CARDAN_INSTANTIATE

}  // namespace cardan
