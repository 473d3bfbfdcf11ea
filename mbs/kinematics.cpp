#include "mbs/kinematics.hpp"

namespace cardan {

template <class S>
WorkspaceT<S>::WorkspaceT(const Model& model) {
    const std::size_t n = static_cast<std::size_t>(model.size());
    for (auto* v : {&o, &e, &r, &C, &w, &al, &a, &F, &N}) v->resize(n);
    for (auto* m : {&E, &P}) m->resize(n);
    for (auto* v : {&V, &A, &S6, &U, &c, &pA}) v->resize(n);
    for (auto* m : {&IA, &B}) m->resize(n);
    for (auto* x : {&D, &u}) x->resize(n);
    M.resize(n);
    bias.setZero(model.size());
    zero.setZero(model.size());
}

template <class S>
KinematicsT<S> kinematics(const Model& model, const Eigen::Ref<const VectorT<S>>& q, WorkspaceT<S>& workspace) {
    WorkspaceT<S>& ws = workspace;
    using std::cos;
    using std::sin;
    assert(q.size() == model.size());
    ++ws.generation;
    const std::size_t n = static_cast<std::size_t>(model.size());
    for (std::size_t k = 0; k < n; ++k) {
        const Model::Body& body = model.bodies()[k];
        const Mat3T<S> R0 = body.joint.R.template cast<S>();
        const Vec3T<S> p0 = body.joint.p.template cast<S>();
        Mat3T<S> R;
        Vec3T<S> origin;
        if (body.parent < 0) {
            R = R0;
            origin = p0;
        } else {
            const std::size_t p = static_cast<std::size_t>(body.parent);
            R.noalias() = ws.E[p] * R0;
            origin.noalias() = ws.E[p] * p0;
            origin += ws.o[p];
        }
        const S qk = q(static_cast<Eigen::Index>(k));
        ws.e[k] = R.col(2);
        if (body.revolute) {
            const S c = cos(qk), s = sin(qk);
            ws.E[k].col(0) = c * R.col(0) + s * R.col(1);
            ws.E[k].col(1) = c * R.col(1) - s * R.col(0);
            ws.E[k].col(2) = R.col(2);
            ws.o[k] = origin;
        } else {
            ws.E[k] = R;
            ws.o[k] = origin + qk * R.col(2);
        }
        ws.r[k] = ws.o[k] + ws.E[k] * body.inertia.com.template cast<S>();
    }
    return KinematicsT<S>(model, ws);
}

template <class S>
BasisFunctions<S> basis_functions(const KinematicsT<S>& kin, int k, int a) {
    BasisFunctions<S> basis{Vec3T<S>::Zero(), Vec3T<S>::Zero()};
    if (!kin.model().precedes(a, k)) return basis;
    const WorkspaceT<S>& ws = kin.workspace();
    const std::size_t ik = static_cast<std::size_t>(k), ia = static_cast<std::size_t>(a);
    const Mat3T<S> to_body = ws.E[ik].transpose();
    if (kin.model().body(a).revolute) {
        basis.u = to_body * cross<S>(ws.e[ia], ws.r[ik] - ws.o[ia]);
        basis.Omega = to_body * ws.e[ia];
    } else {
        basis.u = to_body * ws.e[ia];
    }
    return basis;
}

template <class S>
Pose<S> pose(const KinematicsT<S>& kin, FrameId frame) {
    const Model::Frame& at = kin.model().frame(frame);
    const Mat3T<S> R = at.in_body.R.template cast<S>();
    const Vec3T<S> p = at.in_body.p.template cast<S>();
    if (at.body < 0) return {R, p};
    const WorkspaceT<S>& ws = kin.workspace();
    const std::size_t k = static_cast<std::size_t>(at.body);
    return {ws.E[k] * R, ws.E[k] * p + ws.o[k]};
}

template <class S>
void frame_jacobian(const KinematicsT<S>& kin, FrameId frame, MatrixOutT<S> J) {
    J.setZero();
    const WorkspaceT<S>& ws = kin.workspace();
    const Vec3T<S> point = pose(kin, frame).p;
    for (int a = kin.model().frame(frame).body; a >= 0; a = kin.model().body(a).parent) {
        const std::size_t i = static_cast<std::size_t>(a);
        if (kin.model().body(a).revolute) {
            J.col(a).template head<3>() = ws.e[i];
            J.col(a).template tail<3>() = cross<S>(ws.e[i], point - ws.o[i]);
        } else {
            J.col(a).template tail<3>() = ws.e[i];
        }
    }
}

#define CARDAN_INSTANTIATE(S)                                                                                 \
    template class WorkspaceT<S>;                                                                             \
    template KinematicsT<S> kinematics<S>(const Model&, const Eigen::Ref<const VectorT<S>>&, WorkspaceT<S>&); \
    template BasisFunctions<S> basis_functions<S>(const KinematicsT<S>&, int, int);                           \
    template Pose<S> pose<S>(const KinematicsT<S>&, FrameId);                                                 \
    template void frame_jacobian<S>(const KinematicsT<S>&, FrameId, MatrixOutT<S>);
CARDAN_INSTANTIATE(double)
CARDAN_INSTANTIATE(Complex)
#undef CARDAN_INSTANTIATE

}  // namespace cardan
