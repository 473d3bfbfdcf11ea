#include "mbs/metric.hpp"

namespace cardan {

template <class S>
void composites(const KinematicsT<S>& kin) {
    WorkspaceT<S>& ws = kin.workspace();
    if (ws.composite_generation == ws.generation) return;
    const Model& model = kin.model();
    for (int k = 0; k < model.size(); ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Model::Body& body = model.body(k);
        ws.M[i] = body.inertia.mass;
        ws.C[i] = ws.r[i];
        ws.P[i] = ws.E[i] * binet_tensor<double>(body.J).template cast<S>() * ws.E[i].transpose();
    }
    for (int k = model.size() - 1; k >= 0; --k) {
        if (model.body(k).parent < 0) continue;
        const std::size_t i = static_cast<std::size_t>(k), p = static_cast<std::size_t>(model.body(k).parent);
        ws.P[p] += ws.P[i];
        if (ws.M[i] == 0) continue;
        const double M = ws.M[p] + ws.M[i];
        const Vec3T<S> d = ws.C[i] - ws.C[p];
        ws.P[p] += S(ws.M[p] * ws.M[i] / M) * (d * d.transpose());
        ws.C[p] += S(ws.M[i] / M) * d;
        ws.M[p] = M;
    }
    ws.composite_generation = ws.generation;
}

template <class S>
void add_armatures(const Model& model, MatrixOutT<S> g) {
    for (const Model::Spin& armature : model.armatures())
        for (const auto& [a, sa] : armature.spin)
            for (const auto& [b, sb] : armature.spin) g(a, b) += armature.inertia * (sa * sb);
}

template <class S>
void metric(const KinematicsT<S>& kin, MatrixOutT<S> g) {
    composites(kin);
    const WorkspaceT<S>& ws = kin.workspace();
    const Model& model = kin.model();
    g.setZero();
    for (int m = 0; m < model.size(); ++m) {
        const std::size_t i = static_cast<std::size_t>(m);
        const PointTwist<S> distal = twist_at(kin, m, ws.C[i]);
        const Vec3T<S> momentum = S(ws.M[i]) * distal.v;
        const Vec3T<S> spin = ws.P[i].trace() * distal.w - ws.P[i] * distal.w;
        for (int a = m; a >= 0; a = model.body(a).parent) {
            const PointTwist<S> t = twist_at(kin, a, ws.C[i]);
            g(a, m) = g(m, a) = dot<S>(t.v, momentum) + dot<S>(t.w, spin);
        }
    }
    add_armatures<S>(model, g);
}

std::optional<SingularPivot> singular_pivot(const Matrix& g, const Vector& scale) {
    const Eigen::Index n = g.rows();
    Matrix L = Matrix::Zero(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
        const double pivot = g(j, j) - L.row(j).head(j).squaredNorm();
        if (!(pivot > 1e-12 * scale(j))) return SingularPivot{static_cast<int>(j), pivot, scale(j)};
        L(j, j) = std::sqrt(pivot);
        for (Eigen::Index i = j + 1; i < n; ++i) L(i, j) = (g(i, j) - L.row(i).head(j).dot(L.row(j).head(j))) / L(j, j);
    }
    return std::nullopt;
}

Vector metric_scale(const Kinematics& kin) {
    composites(kin);
    const Workspace& ws = kin.workspace();
    const Model& model = kin.model();
    Vector scale(model.size());
    for (int a = 0; a < model.size(); ++a) {
        const std::size_t i = static_cast<std::size_t>(a);
        scale(a) = ws.M[i];
        if (model.body(a).revolute) scale(a) = ws.M[i] * (ws.C[i] - ws.o[i]).squaredNorm() + ws.P[i].trace();
    }
    for (const Model::Spin& armature : model.armatures())
        for (const auto& [a, s] : armature.spin) scale(a) += std::abs(armature.inertia) * s * s;
    return scale;
}

double kinetic_energy(const Kinematics& kin, VectorIn qd) {
    Workspace& ws = kin.workspace();
    const Model& model = kin.model();
    double twice = 0;
    for (int k = 0; k < model.size(); ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Model::Body& body = model.body(k);
        // Velocity of the joint origin is kept in ws.a.
        if (body.parent < 0) {
            ws.w[i].setZero();
            ws.a[i].setZero();
        } else {
            const std::size_t p = static_cast<std::size_t>(body.parent);
            ws.w[i] = ws.w[p];
            ws.a[i] = ws.a[p] + cross<double>(ws.w[p], ws.o[i] - ws.o[p]);
        }
        (body.revolute ? ws.w[i] : ws.a[i]) += ws.e[i] * qd(k);
        const Vec3 v = ws.a[i] + cross<double>(ws.w[i], ws.r[i] - ws.o[i]);
        const Vec3 w_body = ws.E[i].transpose() * ws.w[i];
        twice += body.inertia.mass * v.squaredNorm() + w_body.dot(body.J * w_body);
    }
    for (const Model::Spin& armature : model.armatures()) {
        double spin = 0;
        for (const auto& [a, s] : armature.spin) spin += s * qd(a);
        twice += armature.inertia * spin * spin;
    }
    return twice / 2;
}

#define CARDAN_INSTANTIATE(S)                                    \
    template void composites<S>(const KinematicsT<S>&);          \
    template void add_armatures<S>(const Model&, MatrixOutT<S>); \
    template void metric<S>(const KinematicsT<S>&, MatrixOutT<S>);
CARDAN_INSTANTIATE(double)
CARDAN_INSTANTIATE(Complex)
#undef CARDAN_INSTANTIATE

}  // namespace cardan
