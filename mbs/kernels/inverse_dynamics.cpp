// Plain twin: tests/mbs/kernels/plain_dynamics.hpp
#include "mbs/kernels/detail/added_mass.hpp"
#include "mbs/kernels/dynamics.hpp"

namespace cardan {

namespace {

// Newton-Euler in base axes, base to tip; a is the acceleration of the joint origin, the load that of the body alone.
template <class S>
CARDAN_INLINE void forward_sweep(std::ptrdiff_t n, const Model::Link* links,
                                 const typename KernelArraysT<S>::Frame* frame, const S* qd, const S* qdd,
                                 typename KernelArraysT<S>::Motion* motion, typename KernelArraysT<S>::Load* load) {
    using P3 = Packed3<S>;
    for (std::ptrdiff_t k = 0; k < n; ++k) {
        const Model::Link& link = links[k];
        P3 w = P3::zero(), al = P3::zero(), a = P3::zero();
        if (link.parent >= 0) {
            const typename KernelArraysT<S>::Motion& parent = motion[link.parent];
            w = parent.w, al = parent.al, a = parent.a;
            if (!link.coincident) {
                const P3 arm = frame[k].o - frame[link.parent].o;
                a += cross(al, arm) + cross(w, cross(w, arm));
            }
        }
        const P3& e = frame[k].E[2];
        const P3 turned = cross(w, qd[k] * e);
        if (link.revolute) {
            al += qdd[k] * e + turned;
            w += qd[k] * e;
        } else {
            a += qdd[k] * e + S(2) * turned;
        }
        motion[k].w = w, motion[k].al = al, motion[k].a = a;
        if (link.massless) {
            load[k] = {P3::zero(), P3::zero()};
            continue;
        }
        const P3 c = frame[k].r - frame[k].o;
        const P3 F = S(link.mass) * (a + cross(al, c) + cross(w, cross(w, c)));
        // Euler's equation in body axes, where the inertia tensor is constant.
        const Packed33<S>& E = frame[k].E;
        const Packed33<S> J = packed<S>(link.J), to_body = transpose(E);
        const P3 w_body = to_body * w;
        load[k] = {F, E * (J * (to_body * al) + cross(w_body, J * w_body)) + cross(c, F)};
    }
}

// Adds up the loads of the subtrees, tip to base, and projects them on the joints.
template <class S>
CARDAN_INLINE void backward_sweep(std::ptrdiff_t n, const Model::Link* links,
                                  const typename KernelArraysT<S>::Frame* frame, typename KernelArraysT<S>::Load* load,
                                  S* tau) {
    Packed3<S> F = Packed3<S>::zero(), N = Packed3<S>::zero();  // what body k + 1 passes to k, if k carries it
    for (std::ptrdiff_t k = n - 1; k >= 0; --k) {
        const Model::Link& link = links[k];
        F += load[k].F;
        N += load[k].N;
        load[k] = {F, N};
        tau[k] = dot(frame[k].E[2], link.revolute ? N : F);
        if (link.parent >= 0 && !link.coincident) N += cross(frame[k].o - frame[link.parent].o, F);
        if (link.run != k) continue;
        if (link.parent >= 0) {
            load[link.parent].F += F;
            load[link.parent].N += N;
        }
        F = N = Packed3<S>::zero();
    }
}

// Adds the forces of entrained water to the loads, with the velocities of the joint origins, which a rigid body's force
// does not depend on.
template <class S>
void add_added_mass_loads(const KinematicsT<S>& kin, VectorInT<S> qd) {
    KernelArraysT<S>& ws = kin.arrays();
    for (const auto& at : ws.entraining) {
        const Model::Link& link = entry(kin.model().links(), at.body);
        const typename KernelArraysT<S>::Frame& frame = entry(ws.frame, at.body);
        typename KernelArraysT<S>::Motion& motion = entry(ws.motion, at.body);
        motion.v = Packed3<S>::zero();
        if (link.parent >= 0) {
            const typename KernelArraysT<S>::Motion& parent = entry(ws.motion, link.parent);
            motion.v = parent.v + cross(parent.w, frame.o - entry(ws.frame, link.parent).o);
        }
        if (!link.revolute) motion.v += qd(at.body) * frame.E[2];
        if (at.own < 0) continue;
        const Vec6T<S> f = added_mass_force<S>(own_added_mass(kin, entry(kin.model().added_masses(), at.own)), motion);
        typename KernelArraysT<S>::Load& load = entry(ws.load, at.body);
        load.N += Packed3<S>::of(f(0), f(1), f(2));
        load.F += Packed3<S>::of(f(3), f(4), f(5));
    }
}

CARDAN_VECTORISED void run_forward(std::ptrdiff_t n, const Model::Link* links, const KernelArrays::Frame* frame,
                                   const double* qd, const double* qdd, KernelArrays::Motion* motion,
                                   KernelArrays::Load* load) {
    forward_sweep<double>(n, links, frame, qd, qdd, motion, load);
}
CARDAN_VECTORISED void run_backward(std::ptrdiff_t n, const Model::Link* links, const KernelArrays::Frame* frame,
                                    KernelArrays::Load* load, double* tau) {
    backward_sweep<double>(n, links, frame, load, tau);
}

void run_forward(std::ptrdiff_t n, const Model::Link* links, const KernelArraysT<Complex>::Frame* frame,
                 const Complex* qd, const Complex* qdd, KernelArraysT<Complex>::Motion* motion,
                 KernelArraysT<Complex>::Load* load) {
    forward_sweep<Complex>(n, links, frame, qd, qdd, motion, load);
}
void run_backward(std::ptrdiff_t n, const Model::Link* links, const KernelArraysT<Complex>::Frame* frame,
                  KernelArraysT<Complex>::Load* load, Complex* tau) {
    backward_sweep<Complex>(n, links, frame, load, tau);
}

}  // namespace

template <class S>
void inverse_dynamics(const KinematicsT<S>& kin, VectorInT<S> qd, VectorInT<S> qdd, VectorOutT<S> tau) {
    KernelArraysT<S>& ws = kin.arrays();
    const Model& model = kin.model();
    require_size("inverse dynamics", "qd", qd, model.size());
    require_size("inverse dynamics", "qdd", qdd, model.size());
    require_size("inverse dynamics", "tau", tau, model.size());
    run_forward(model.size(), model.links().data(), ws.frame.data(), qd.data(), qdd.data(), ws.motion.data(),
                ws.load.data());
    add_added_mass_loads<S>(kin, qd);
    run_backward(model.size(), model.links().data(), ws.frame.data(), ws.load.data(), tau.data());
    for (const Model::Spin& armature : model.armatures()) {
        S spin(0);
        for (const auto& [a, s] : armature.spin) spin += s * qdd(a);
        for (const auto& [a, s] : armature.spin) tau(a) += armature.inertia * s * spin;
    }
}

template <class S>
void inertial_forces(const KinematicsT<S>& kin, VectorInT<S> qd, VectorOutT<S> h) {
    inverse_dynamics<S>(kin, qd, kin.arrays().zero, h);
}

#define CARDAN_INSTANTIATE(S)                                                                            \
    template void inverse_dynamics<S>(const KinematicsT<S>&, VectorInT<S>, VectorInT<S>, VectorOutT<S>); \
    template void inertial_forces<S>(const KinematicsT<S>&, VectorInT<S>, VectorOutT<S>);
CARDAN_INSTANTIATE(double)
CARDAN_INSTANTIATE(Complex)
#undef CARDAN_INSTANTIATE

}  // namespace cardan
