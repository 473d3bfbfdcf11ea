#include "mbs/kernels/metric.hpp"

#include "mbs/kernels/detail/added_mass.hpp"
#include "mbs/kernels/registers/path_twists.hpp"

namespace cardan {

template <class S>
void add_armatures(const Model& model, MatrixOutT<S> g) {
    require_size("metric", "g", g, model.size(), model.size());
    for (const Model::Spin& armature : model.armatures())
        for (const auto& [a, sa] : armature.spin)
            for (const auto& [b, sb] : armature.spin) g(a, b) += armature.inertia * (sa * sb);
}

namespace {

// Row m of the lower triangle, by depth: g_am = v_a . M v_m + w_a . (tr P - P) w_m, at the centre C of the subtree of
// m.
template <class S>
CARDAN_INLINE void branch_row(const PathTwists<S>& path, const Model::Link& link,
                              const typename KernelArraysT<S>::Frame& frame,
                              const typename KernelArraysT<S>::Inertia& body, Packed3<S>* row) {
    using Columns = Packed3<S>;
    const Packed3<S>& e = frame.E[2];
    const Packed3<S> p = body.M * (link.revolute ? cross(e, body.C - frame.o) : e);
    Packed3<S> spin = Packed3<S>::zero();
    if (link.revolute) spin = (body.P[0](0) + body.P[1](1) + body.P[2](2)) * e - body.P * e;
    const Columns cx = broadcast<0>(body.C), cy = broadcast<1>(body.C), cz = broadcast<2>(body.C);
    const Columns sx = broadcast<0>(spin), sy = broadcast<1>(spin), sz = broadcast<2>(spin);
    const Columns px = broadcast<0>(p), py = broadcast<1>(p), pz = broadcast<2>(p);
    for (std::ptrdiff_t j = 0; j < path.blocks(link.depth); ++j) {
        const Columns x = cx - path.o(0)[j], y = cy - path.o(1)[j], z = cz - path.o(2)[j];
        row[j] = times(path.w(0)[j], sx + times(y, pz) - times(z, py)) +
                 times(path.w(1)[j], sy + times(z, px) - times(x, pz)) +
                 times(path.w(2)[j], sz + times(x, py) - times(y, px)) +
                 (times(path.u(0)[j], px) + times(path.u(1)[j], py) + times(path.u(2)[j], pz));
    }
}

template <class S, class Sink>
CARDAN_INLINE void fill(int n, const Model::Link* links, const typename KernelArraysT<S>::Frame* frame,
                        const typename KernelArraysT<S>::Inertia* composite, const PathTwists<S>& path,
                        const Sink& sink) {
    for (int first = 0; first < n;) {
        const int end = set_run(path, links, frame, first, n);
        for (int m = first; m < end; ++m) {
            Packed3<S>*const row = sink.row_of(m), *const column = sink.column_of(m);
            branch_row(path, links[m], frame[m], composite[m], row);
            for (std::ptrdiff_t j = 0; j < path.blocks(links[m].depth); ++j) column[j] = row[j];
            sink.written(m);
        }
        first = end;
    }
}

// Calls add(a, b, value) for what added mass adds to g_ab.
template <class S, class Add>
void add_added_mass(const KinematicsT<S>& kin, const Add& add) {
    for (const auto& at : kin.arrays().entraining) {
        const int m = at.body;
        const Vec3T<S> o = entry(kin.arrays().frame, m).o.vector();
        const Vec6T<S> momentum = at.I * twist_column(kin, m, o);
        add(m, m, work<S>(twist_column(kin, m, o), momentum));
        for (int a = own_parent(kin.model(), m); a >= 0; a = own_parent(kin.model(), a)) {
            const S value = work<S>(twist_column(kin, a, o), momentum);
            add(a, m, value);
            add(m, a, value);
        }
    }
}

CARDAN_VECTORISED void run(int n, const Model::Link* links, const KernelArrays::Frame* frame,
                           const KernelArrays::Inertia* composite, const PathTwists<double>& path,
                           const DenseSink<double>& g) {
    fill<double>(n, links, frame, composite, path, g);
}
CARDAN_VECTORISED void run(int n, const Model::Link* links, const KernelArrays::Frame* frame,
                           const KernelArrays::Inertia* composite, const PathTwists<double>& path,
                           const BranchSink& g) {
    fill<double>(n, links, frame, composite, path, g);
}
void run(int n, const Model::Link* links, const KernelArraysT<Complex>::Frame* frame,
         const KernelArraysT<Complex>::Inertia* composite, const PathTwists<Complex>& path,
         const DenseSink<Complex>& g) {
    fill<Complex>(n, links, frame, composite, path, g);
}

}  // namespace

template <class S>
void metric(const KinematicsT<S>& kin, MatrixOutT<S> g) {
    const Model& model = kin.model();
    require_size("metric", "g", g, model.size(), model.size());
    composites(kin);
    KernelArraysT<S>& ws = kin.arrays();
    const PathTwists<S> path(ws.branch.data(), ws.stride);
    run(model.size(), model.links().data(), ws.frame.data(), ws.composite.data(), path,
        DenseSink<S>{model.links().data(), model.size(), g.data(), g.outerStride(), path.row(0), path.row(0)});
    add_added_mass(kin, [&](int a, int b, const S& value) { g(a, b) += value; });
    add_armatures<S>(model, g);
}

void metric(const Kinematics& kin, BranchMatrix& g) {
    const Model& model = kin.model();
    require_model("metric", "branch matrix", g.model().serial(), model.serial());
    composites(kin);
    KernelArrays& ws = kin.arrays();
    run(model.size(), model.links().data(), ws.frame.data(), ws.composite.data(),
        PathTwists<double>(ws.branch.data(), ws.stride), BranchSink(g));
    add_added_mass(kin, [&](int a, int b, double value) { g.add(a, b, value); });
    for (const Model::Spin& armature : model.armatures())
        for (const auto& [a, sa] : armature.spin)
            for (const auto& [b, sb] : armature.spin) g.add(a, b, armature.inertia * (sa * sb));
}

std::optional<SingularPivot> singular_pivot(const Matrix& g, const Vector& scale) {
    const Eigen::Index n = g.rows();
    require_size("singular pivot", "g", g, n, n);
    require_size("singular pivot", "scale", scale, n);
    Matrix L = Matrix::Zero(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
        const double pivot = g(j, j) - L.row(j).head(j).squaredNorm();
        if (!(pivot > 1e-12 * scale(j))) return SingularPivot{static_cast<int>(j), pivot, scale(j)};
        L(j, j) = std::sqrt(pivot);
        for (Eigen::Index i = j + 1; i < n; ++i) L(i, j) = (g(i, j) - L.row(i).head(j).dot(L.row(j).head(j))) / L(j, j);
    }
    return std::nullopt;
}

double kinetic_energy(const Kinematics& kin, VectorIn qd) {
    KernelArrays& ws = kin.arrays();
    const Model& model = kin.model();
    require_size("kinetic energy", "qd", qd, model.size());
    double twice = 0;
    for (int k = 0; k < model.size(); ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Model::Link& link = model.links()[i];
        const KernelArrays::Frame& frame = ws.frame[i];
        KernelArrays::Motion& motion = ws.motion[i];
        motion.w = motion.v = Packed3<double>::zero();
        if (link.parent >= 0) {
            const std::size_t p = static_cast<std::size_t>(link.parent);
            motion.w = ws.motion[p].w;
            motion.v = ws.motion[p].v + cross(motion.w, frame.o - ws.frame[p].o);
        }
        (link.revolute ? motion.w : motion.v) += qd(k) * frame.E[2];
        const Packed3<double> v = motion.v + cross(motion.w, frame.r - frame.o);
        const Packed3<double> w_body = transpose(frame.E) * motion.w;
        twice += link.mass * dot(v, v) + dot(w_body, link.J * w_body);
    }
    for (const Model::Spin& armature : model.armatures()) {
        double spin = 0;
        for (const auto& [a, s] : armature.spin) spin += s * qd(a);
        twice += armature.inertia * spin * spin;
    }
    for (const Model::AddedMass& water : model.added_masses()) {
        const Vec6 v = twist_column<double>(entry(ws.motion, water.body));
        twice += work<double>(v, own_added_mass(kin, water) * v);
    }
    return twice / 2;
}

#define CARDAN_INSTANTIATE(S)                                    \
    template void add_armatures<S>(const Model&, MatrixOutT<S>); \
    template void metric<S>(const KinematicsT<S>&, MatrixOutT<S>);
CARDAN_INSTANTIATE(double)
CARDAN_INSTANTIATE(Complex)
#undef CARDAN_INSTANTIATE

}  // namespace cardan
