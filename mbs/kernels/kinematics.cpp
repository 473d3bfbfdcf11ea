#include "mbs/kernels/kinematics.hpp"

#include "mbs/base/elementary.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/registers/path_twists.hpp"

#include <algorithm>
#include <utility>

namespace cardan {

template <class S>
WorkspaceT<S>::WorkspaceT(const Model& model) : model_serial_(model.serial()) {
    with_memory([&] { return text("the workspace of a model of ", model.size(), " bodies"); },
                [&] { arrays_ = std::make_unique<KernelArraysT<S>>(model); });
}

template <class S>
WorkspaceT<S>::WorkspaceT(const WorkspaceT& other)
    : arrays_(other.arrays_ ? std::make_unique<KernelArraysT<S>>(*other.arrays_) : nullptr),
      model_serial_(other.model_serial_),
      generation_(other.generation_) {}

template <class S>
WorkspaceT<S>::WorkspaceT(WorkspaceT&& other) noexcept
    : arrays_(std::move(other.arrays_)),
      model_serial_(std::exchange(other.model_serial_, 0)),
      generation_(other.generation_) {}

template <class S>
WorkspaceT<S>& WorkspaceT<S>::operator=(const WorkspaceT& other) {
    return *this = WorkspaceT(other);
}

template <class S>
WorkspaceT<S>& WorkspaceT<S>::operator=(WorkspaceT&& other) noexcept {
    arrays_ = std::move(other.arrays_);
    model_serial_ = std::exchange(other.model_serial_, 0);
    generation_ = other.generation_;
    return *this;
}

template <class S>
WorkspaceT<S>::~WorkspaceT() = default;

template <class S>
KernelArraysT<S>::KernelArraysT(const Model& model) {
    const std::size_t n = static_cast<std::size_t>(model.size());
    frame.resize(n);
    J.resize(n);
    composite.resize(n);
    motion.resize(n);
    load.resize(n);
    momentum.resize(n);
    rates.resize(n);
    sine.setZero(model.size());
    cosine.setZero(model.size());
    zero.setZero(model.size());
    int deepest = 0;
    for (const Model::Link& link : model.links()) deepest = std::max(deepest, link.depth);
    stride = PathTwists<S>::blocks(deepest);
    branch.assign(static_cast<std::size_t>(PathTwists<S>::rows * stride), Packed3<S>::zero());
    if (!model.added_masses().empty()) find_entraining(model);
}

template <class S>
void KernelArraysT<S>::find_entraining(const Model& model) {
    std::vector<int> place(frame.size(), -1);
    int own = 0;
    for (int k = 0; k < model.size(); ++k) {
        if (!model.entrains(k)) continue;
        entry(place, k) = static_cast<int>(entraining.size());
        const int parent = model.body(k).parent;
        const bool has = own < std::ssize(model.added_masses()) && entry(model.added_masses(), own).body == k;
        entraining.push_back({k, parent < 0 ? -1 : entry(place, parent), has ? own++ : -1});
    }
}

namespace {

template <class S>
CARDAN_INLINE void frames(std::ptrdiff_t n, const Model::Link* links, const S* q, const S* sine, const S* cosine,
                          typename KernelArraysT<S>::Frame* frame) {
    for (std::ptrdiff_t k = 0; k < n; ++k) {
        const Model::Link& link = links[k];
        Packed33<S> R = packed<S>(link.R);
        Packed3<S> o = packed<S>(link.p);
        if (link.parent >= 0) {
            const typename KernelArraysT<S>::Frame& parent = frame[link.parent];
            R = parent.E * R;
            o = link.coincident ? parent.o : parent.o + parent.E * o;
        }
        if (link.revolute) {
            const Packed3<S> x = R[0];
            R[0] = cosine[k] * x + sine[k] * R[1];
            R[1] = cosine[k] * R[1] - sine[k] * x;
        } else {
            o += q[k] * R[2];
        }
        frame[k] = {R, o, link.massless ? o : o + R * packed<S>(link.com)};
    }
}

CARDAN_VECTORISED void run(std::ptrdiff_t n, const Model::Link* links, const double* q, const double* sine,
                           const double* cosine, KernelArrays::Frame* frame) {
    frames<double>(n, links, q, sine, cosine, frame);
}

void run(std::ptrdiff_t n, const Model::Link* links, const Complex* q, const Complex* sine, const Complex* cosine,
         KernelArraysT<Complex>::Frame* frame) {
    frames<Complex>(n, links, q, sine, cosine, frame);
}

}  // namespace

template <class S>
KinematicsT<S> kinematics(const Model& model, VectorInT<S> q, WorkspaceT<S>& workspace) {
    require_size("kinematics", "q", q, model.size());
    require_model("kinematics", "workspace", workspace.model_serial(), model.serial());
    ++workspace.generation_;
    KernelArraysT<S>& arrays = *workspace.arrays_;
    sines(q, arrays.sine, arrays.cosine);
    run(model.size(), model.links().data(), q.data(), arrays.sine.data(), arrays.cosine.data(), arrays.frame.data());
    return KinematicsT<S>(model, workspace, numbers(arrays.frame.front().E.column));
}

template <class S>
BasisFunctions<S> basis_functions(const KinematicsT<S>& kin, int k, int a) {
    require_index("basis functions", "body", k, kin.model().size());
    require_index("basis functions", "coordinate", a, kin.model().size());
    BasisFunctions<S> basis{Vec3T<S>::Zero(), Vec3T<S>::Zero()};
    if (!kin.model().precedes(a, k)) return basis;
    const Mat3T<S> to_body = kin.rotation(k).transpose();
    const PointTwist<S> twist = twist_at(kin, a, kin.centre_of_mass(k));
    basis.u = to_body * twist.v;
    basis.Omega = to_body * twist.w;
    return basis;
}

template <class S>
Pose<S> pose(const KinematicsT<S>& kin, FrameId frame) {
    const Model::Frame& at = kin.model().frame(frame);
    const Mat3T<S> R = at.in_body.R.template cast<S>();
    const Vec3T<S> p = at.in_body.p.template cast<S>();
    if (at.body < 0) return {R, p};
    const Mat3T<S> E = kin.rotation(at.body);
    return {E * R, E * p + kin.origin(at.body)};
}

template <class S>
void frame_jacobian(const KinematicsT<S>& kin, FrameId frame, MatrixOutT<S> J) {
    require_size("frame Jacobian", "J", J, 6, kin.model().size());
    J.setZero();
    const Vec3T<S> point = pose(kin, frame).p;
    for (int a = kin.model().frame(frame).body; a >= 0; a = kin.model().body(a).parent) {
        const PointTwist<S> twist = twist_at(kin, a, point);
        J.col(a) << twist.w, twist.v;
    }
}

#define CARDAN_INSTANTIATE(S)                                                          \
    template class WorkspaceT<S>;                                                      \
    template KinematicsT<S> kinematics<S>(const Model&, VectorInT<S>, WorkspaceT<S>&); \
    template BasisFunctions<S> basis_functions<S>(const KinematicsT<S>&, int, int);    \
    template Pose<S> pose<S>(const KinematicsT<S>&, FrameId);                          \
    template void frame_jacobian<S>(const KinematicsT<S>&, FrameId, MatrixOutT<S>);
CARDAN_INSTANTIATE(double)
CARDAN_INSTANTIATE(Complex)
#undef CARDAN_INSTANTIATE

}  // namespace cardan
