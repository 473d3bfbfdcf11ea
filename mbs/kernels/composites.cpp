#include "mbs/kernels/composites.hpp"

#include "mbs/kernels/detail/added_mass.hpp"

namespace cardan {

namespace {

template <class S>
CARDAN_INLINE void rotate(std::ptrdiff_t n, const Model::Link* links, const typename KernelArraysT<S>::Frame* frame,
                          Packed33<S>* J) {
    for (std::ptrdiff_t k = 0; k < n; ++k)
        if (!links[k].massless) J[k] = rotated(frame[k].E, packed<S>(links[k].J));
}

// Two bodies about their common centre: the Binet tensors and the reduced mass at their distance.
template <class S>
CARDAN_INLINE void merge(std::ptrdiff_t n, const Model::Link* links, const typename KernelArraysT<S>::Frame* frame,
                         const Packed33<S>* J, typename KernelArraysT<S>::Inertia* composite) {
    for (std::ptrdiff_t k = 0; k < n; ++k) {
        typename KernelArraysT<S>::Inertia& own = composite[k];
        own.M = S(links[k].subtree_mass);
        own.C = frame[k].r;
        own.P = {{Packed3<S>::zero(), Packed3<S>::zero(), Packed3<S>::zero()}};
        if (!links[k].massless) own.P = binet(J[k]);
    }
    for (std::ptrdiff_t k = n - 1; k >= 0; --k) {
        const Model::Link& link = links[k];
        if (link.parent < 0) continue;
        const typename KernelArraysT<S>::Inertia& own = composite[k];
        typename KernelArraysT<S>::Inertia& parent = composite[link.parent];
        const Packed3<S> d = own.C - parent.C, moment = S(link.reduced) * d;
        parent.C += S(link.share) * d;
        parent.P[0] += own.P[0] + times(moment, broadcast<0>(d));
        parent.P[1] += own.P[1] + times(moment, broadcast<1>(d));
        parent.P[2] += own.P[2] + times(moment, broadcast<2>(d));
    }
}

template <class S>
CARDAN_INLINE void centres(std::ptrdiff_t n, const Model::Link* links, const typename KernelArraysT<S>::Frame* frame,
                           typename KernelArraysT<S>::Inertia* composite) {
    for (std::ptrdiff_t k = 0; k < n; ++k) {
        composite[k].M = S(links[k].subtree_mass);
        composite[k].C = frame[k].r;
    }
    for (std::ptrdiff_t k = n - 1; k >= 0; --k) {
        const Model::Link& link = links[k];
        if (link.parent < 0) continue;
        Packed3<S>& parent = composite[link.parent].C;
        parent += S(link.share) * (composite[k].C - parent);
    }
}

CARDAN_VECTORISED void run_centres(std::ptrdiff_t n, const Model::Link* links, const KernelArrays::Frame* frame,
                                   KernelArrays::Inertia* composite) {
    centres<double>(n, links, frame, composite);
}
void run_centres(std::ptrdiff_t n, const Model::Link* links, const KernelArraysT<Complex>::Frame* frame,
                 KernelArraysT<Complex>::Inertia* composite) {
    centres<Complex>(n, links, frame, composite);
}

CARDAN_VECTORISED void run_rotate(std::ptrdiff_t n, const Model::Link* links, const KernelArrays::Frame* frame,
                                  Packed33<double>* J) {
    rotate<double>(n, links, frame, J);
}
void run_rotate(std::ptrdiff_t n, const Model::Link* links, const KernelArraysT<Complex>::Frame* frame,
                Packed33<Complex>* J) {
    rotate<Complex>(n, links, frame, J);
}

CARDAN_VECTORISED void run_merge(std::ptrdiff_t n, const Model::Link* links, const KernelArrays::Frame* frame,
                                 const Packed33<double>* J, KernelArrays::Inertia* composite) {
    merge<double>(n, links, frame, J, composite);
}
void run_merge(std::ptrdiff_t n, const Model::Link* links, const KernelArraysT<Complex>::Frame* frame,
               const Packed33<Complex>* J, KernelArraysT<Complex>::Inertia* composite) {
    merge<Complex>(n, links, frame, J, composite);
}

}  // namespace

template <class S>
void body_inertias(const KinematicsT<S>& kin) {
    KernelArraysT<S>& ws = kin.arrays();
    if (ws.inertia_generation == kin.workspace().generation()) return;
    const Model& model = kin.model();
    run_rotate(model.size(), model.links().data(), ws.frame.data(), ws.J.data());
    ws.inertia_generation = kin.workspace().generation();
}

template <class S>
void subtree_centres(const KinematicsT<S>& kin) {
    KernelArraysT<S>& ws = kin.arrays();
    if (ws.centre_generation == kin.workspace().generation()) return;
    const Model& model = kin.model();
    run_centres(model.size(), model.links().data(), ws.frame.data(), ws.composite.data());
    ws.centre_generation = kin.workspace().generation();
}

template <class S>
void composites(const KinematicsT<S>& kin) {
    KernelArraysT<S>& ws = kin.arrays();
    if (ws.composite_generation == kin.workspace().generation()) return;
    body_inertias(kin);
    const Model& model = kin.model();
    run_merge(model.size(), model.links().data(), ws.frame.data(), ws.J.data(), ws.composite.data());
    gather_added_mass(kin);
    ws.centre_generation = ws.composite_generation = kin.workspace().generation();
}

#define CARDAN_INSTANTIATE(S)                                \
    template void body_inertias<S>(const KinematicsT<S>&);   \
    template void subtree_centres<S>(const KinematicsT<S>&); \
    template void composites<S>(const KinematicsT<S>&);
CARDAN_INSTANTIATE(double)
CARDAN_INSTANTIATE(Complex)
#undef CARDAN_INSTANTIATE

}  // namespace cardan
