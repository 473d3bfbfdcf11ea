// Plain twin: tests/mbs/kernels/plain_dynamics.hpp
#include "mbs/kernels/derivatives.hpp"

#include "mbs/kernels/composites.hpp"
#include "mbs/kernels/path_twists.hpp"

namespace cardan {

namespace {

// Rows of the branch besides the twists S_j = (w, u): Psi' = v x S and Psi'' = a x S + v x Psi' of the carrier's
// spatial velocity v and acceleration a, their linear parts at o_j.
enum BranchRows { psi1_w = 0, psi1_u = 3, psi2_w = 6, psi2_u = 9, scratch = 12 };

template <class S>
using Rates = typename WorkspaceT<S>::Rates;

// Motion of body k; returns Psi' and Psi'' of its coordinate.
template <class S>
CARDAN_INLINE Rates<S> advance(const Model::Link& link, const typename WorkspaceT<S>::Frame* frame, std::ptrdiff_t k,
                               const S& qd, const S& qdd, typename WorkspaceT<S>::Motion* motion) {
    using P3 = Packed3<S>;
    P3 w = P3::zero(), al = P3::zero(), v = P3::zero(), a = P3::zero();
    if (link.parent >= 0) {
        const typename WorkspaceT<S>::Motion& carrier = motion[link.parent];
        w = carrier.w, al = carrier.al, v = carrier.v, a = carrier.a;
        if (!link.coincident) {
            const P3 arm = frame[k].o - frame[link.parent].o, sweep = cross(w, arm);
            v += sweep;
            a += cross(al, arm) + cross(w, sweep);
        }
    }
    const P3& e = frame[k].E[2];
    const P3 turned = cross(w, e), turned_twice = cross(al, e) + cross(w, turned);
    Rates<S> rates;
    if (link.revolute) {
        rates.psi1_w = turned;
        rates.psi1_u = cross(v, e);
        rates.psi2_w = turned_twice;
        rates.psi2_u = cross(a - cross(w, v), e) + cross(w, rates.psi1_u) + cross(v, turned);
        al += qdd * e + qd * turned;
        w += qd * e;
    } else {
        rates.psi1_w = rates.psi2_w = P3::zero();
        rates.psi1_u = turned;
        rates.psi2_u = turned_twice;
        a += qdd * e + (S(2) * qd) * turned;
        v += qd * e;
    }
    motion[k] = {w, al, v, a};
    return rates;
}

// Momentum and force of body k alone, moments about its joint origin.
template <class S>
CARDAN_INLINE void own_load(const Model::Link& link, const typename WorkspaceT<S>::Frame& frame, const Packed33<S>& J,
                            const typename WorkspaceT<S>::Motion& motion, typename WorkspaceT<S>::Momentum& momentum,
                            typename WorkspaceT<S>::Load& load) {
    using P3 = Packed3<S>;
    if (link.massless) {
        momentum = {P3::zero(), {{P3::zero(), P3::zero(), P3::zero()}}};
        load = {P3::zero(), P3::zero()};
        return;
    }
    const P3 c = frame.r - frame.o, sweep = cross(motion.w, c);
    const S m(link.mass);
    momentum.p = m * (motion.v + sweep);
    momentum.G = minus_times_skew(binet(J), motion.w);  // sum m rho (w x rho)^T
    for (int j = 0; j < 3; ++j) momentum.G[j] += momentum.p(j) * c;
    load.F = m * (motion.a + cross(motion.al, c) + cross(motion.w, sweep));
    load.N = J * motion.al + cross(motion.w, J * motion.w) + cross(c, load.F);
}

// (tr G - G) x
template <class S>
CARDAN_INLINE Packed3<S> spin(const Packed33<S>& G, const Packed3<S>& x) {
    return (G[0](0) + G[1](1) + G[2](2)) * x - G * x;
}

// What row and column k of the derivatives need of the subtree of k, at its centre of mass C. A subtree that is carried
// by the twist Psi has the inertial forces I Psi'' and 2 B Psi', where B Psi = sum m w_Psi x x_dot.
template <class S>
struct Subtree {
    Packed3<S> C;
    Packed3<S> momentum, spin;  ///< I S_k
    Packed3<S> B_row;           ///< S_k . B Psi = B_row . w_Psi
    Packed3<S> force_q, moment_q, force_qd, moment_qd;
};

template <class S>
CARDAN_INLINE Subtree<S> subtree_of(const Model::Link& link, const typename WorkspaceT<S>::Frame& frame,
                                    const typename WorkspaceT<S>::Inertia& body,
                                    const typename WorkspaceT<S>::Momentum& momentum,
                                    const typename WorkspaceT<S>::Load& load, const Rates<S>& rates) {
    using P3 = Packed3<S>;
    const P3& e = frame.E[2];
    const P3 arm = body.C - frame.o;
    const P3 w = link.revolute ? e : P3::zero(), v = link.revolute ? cross(e, arm) : e;
    Packed33<S> G = momentum.G;
    for (int j = 0; j < 3; ++j) G[j] -= momentum.p(j) * arm;
    const Packed33<S> Gt = transpose(G);
    const P3 &p = momentum.p, moment = load.N - cross(arm, load.F);
    const P3 v1 = rates.psi1_u + cross(rates.psi1_w, arm), v2 = rates.psi2_u + cross(rates.psi2_w, arm);
    const P3 force_q = S(2) * cross(rates.psi1_w, p) + body.M * v2 + cross(w, load.F);
    const P3 moment_q =
        S(2) * spin(Gt, rates.psi1_w) + spin(body.P, rates.psi2_w) + cross(w, moment) + cross(v, load.F);
    const P3 force_qd = S(2) * (cross(w, p) + body.M * v1);
    const P3 moment_qd = S(2) * (spin(Gt, w) + spin(body.P, rates.psi1_w));
    return {body.C, body.M * v, spin(body.P, w), cross(p, v) + spin(G, w), force_q, moment_q, force_qd, moment_qd};
}

// The products of subtree k with four coordinates on its path.
template <class S>
CARDAN_INLINE void branch_products(const PathTwists<S>& path, std::ptrdiff_t blocks, const Subtree<S>& s,
                                   Packed3<S>* row_q, Packed3<S>* row_qd, Packed3<S>* column_q, Packed3<S>* column_qd) {
    using Columns = Packed3<S>;
    const Columns cx = broadcast<0>(s.C), cy = broadcast<1>(s.C), cz = broadcast<2>(s.C);
    const auto about_o = [&](std::ptrdiff_t j, const Packed3<S>& force, const Packed3<S>& moment,
                             Columns* sum) CARDAN_INLINE_LAMBDA {
        const Columns x = cx - path.o(0)[j], y = cy - path.o(1)[j], z = cz - path.o(2)[j];
        const Columns fx = broadcast<0>(force), fy = broadcast<1>(force), fz = broadcast<2>(force);
        sum[0] = broadcast<0>(moment) + times(y, fz) - times(z, fy);
        sum[1] = broadcast<1>(moment) + times(z, fx) - times(x, fz);
        sum[2] = broadcast<2>(moment) + times(x, fy) - times(y, fx);
    };
    const auto product = [&](std::ptrdiff_t j, int first_row, const Columns* v) CARDAN_INLINE_LAMBDA {
        return times(v[0], path.row(first_row)[j]) + times(v[1], path.row(first_row + 1)[j]) +
               times(v[2], path.row(first_row + 2)[j]);
    };
    const auto fixed = [&](std::ptrdiff_t j, int first_row, const Packed3<S>& v) CARDAN_INLINE_LAMBDA {
        return times(broadcast<0>(v), path.row(first_row)[j]) + times(broadcast<1>(v), path.row(first_row + 1)[j]) +
               times(broadcast<2>(v), path.row(first_row + 2)[j]);
    };
    const Packed3<S> B_row = S(2) * s.B_row, momentum = S(2) * s.momentum;
    for (std::ptrdiff_t j = 0; j < blocks; ++j) {
        Columns moment[3];
        about_o(j, s.momentum, s.spin, moment);
        row_q[j] = fixed(j, psi1_w, B_row) + product(j, psi2_w, moment) + fixed(j, psi2_u, s.momentum);
        row_qd[j] =
            fixed(j, PathTwists<S>::w_rows, B_row) + S(2) * product(j, psi1_w, moment) + fixed(j, psi1_u, momentum);
        about_o(j, s.force_q, s.moment_q, moment);
        column_q[j] = product(j, PathTwists<S>::w_rows, moment) + fixed(j, PathTwists<S>::u_rows, s.force_q);
        about_o(j, s.force_qd, s.moment_qd, moment);
        column_qd[j] = product(j, PathTwists<S>::w_rows, moment) + fixed(j, PathTwists<S>::u_rows, s.force_qd);
    }
}

template <class S>
CARDAN_INLINE void set_rates(const PathTwists<S>& path, std::ptrdiff_t column,
                             const typename WorkspaceT<S>::Rates& rates) {
    path.set(psi1_w, column, rates.psi1_w);
    path.set(psi1_u, column, rates.psi1_u);
    path.set(psi2_w, column, rates.psi2_w);
    path.set(psi2_u, column, rates.psi2_u);
}

template <class S>
struct Arguments {
    int n;
    const Model::Link* links;
    const typename WorkspaceT<S>::Frame* frame;
    const typename WorkspaceT<S>::Inertia* composite;
    const Packed33<S>* J;
    typename WorkspaceT<S>::Motion* motion;
    typename WorkspaceT<S>::Momentum* momentum;
    typename WorkspaceT<S>::Load* load;
    typename WorkspaceT<S>::Rates* rates;
    PathTwists<S> path;
    const S *qd, *qdd;
};

template <class S, class Sink>
CARDAN_INLINE void differentiate(const Arguments<S>& x, const Sink& by_q, const Sink& by_qd) {
    for (int k = 0; k < x.n; ++k) {
        x.rates[k] = advance<S>(x.links[k], x.frame, k, x.qd[k], x.qdd[k], x.motion);
        own_load<S>(x.links[k], x.frame[k], x.J[k], x.motion[k], x.momentum[k], x.load[k]);
    }
    for (int k = x.n - 1; k > 0; --k) {
        const int p = x.links[k].parent;
        if (p < 0) continue;
        const Packed3<S> arm = x.frame[k].o - x.frame[p].o;
        x.momentum[p].p += x.momentum[k].p;
        x.momentum[p].G += x.momentum[k].G;
        for (int j = 0; j < 3; ++j) x.momentum[p].G[j] += x.momentum[k].p(j) * arm;
        x.load[p].F += x.load[k].F;
        x.load[p].N += x.load[k].N + cross(arm, x.load[k].F);
    }
    for (int first = 0; first < x.n;) {
        const int end = set_run(x.path, x.links, x.frame, first, x.n);
        for (int k = first; k < end; ++k) set_rates(x.path, x.links[k].depth - 1, x.rates[k]);
        for (int k = first; k < end; ++k) {
            const Subtree<S> s =
                subtree_of<S>(x.links[k], x.frame[k], x.composite[k], x.momentum[k], x.load[k], x.rates[k]);
            branch_products(x.path, x.path.blocks(x.links[k].depth), s, by_q.row_of(k), by_qd.row_of(k),
                            by_q.column_of(k), by_qd.column_of(k));
            by_q.written(k);
            by_qd.written(k);
        }
        first = end;
    }
}

CARDAN_VECTORISED void run(const Arguments<double>& x, const DenseSink<double>& by_q, const DenseSink<double>& by_qd) {
    differentiate(x, by_q, by_qd);
}
CARDAN_VECTORISED void run(const Arguments<double>& x, const BranchSink<double>& by_q,
                           const BranchSink<double>& by_qd) {
    differentiate(x, by_q, by_qd);
}
template <class Sink>
void run(const Arguments<Complex>& x, const Sink& by_q, const Sink& by_qd) {
    differentiate(x, by_q, by_qd);
}

constexpr const char* in_derivatives = "derivatives of the inverse dynamics";

template <class S>
Arguments<S> arguments(const KinematicsT<S>& kin, VectorInT<S> qd, VectorInT<S> qdd) {
    require_size(in_derivatives, "qd", qd, kin.model().size());
    require_size(in_derivatives, "qdd", qdd, kin.model().size());
    composites(kin);
    WorkspaceT<S>& ws = kin.workspace();
    return {kin.model().size(), kin.model().links().data(),
            ws.frame.data(),    ws.composite.data(),
            ws.J.data(),        ws.motion.data(),
            ws.momentum.data(), ws.load.data(),
            ws.rates.data(),    PathTwists<S>(ws.branch.data(), ws.stride),
            qd.data(),          qdd.data()};
}

}  // namespace

template <class S>
void inverse_dynamics_derivatives(const KinematicsT<S>& kin, VectorInT<S> qd, VectorInT<S> qdd, MatrixOutT<S> dtau_dq,
                                  MatrixOutT<S> dtau_dqd) {
    const Arguments<S> x = arguments<S>(kin, qd, qdd);
    require_size(in_derivatives, "dtau_dq", dtau_dq, x.n, x.n);
    require_size(in_derivatives, "dtau_dqd", dtau_dqd, x.n, x.n);
    const auto sink = [&](MatrixOutT<S>& A, int row) {
        return DenseSink<S>{x.links, x.n, A.data(), A.outerStride(), x.path.row(row), x.path.row(row + 1)};
    };
    run(x, sink(dtau_dq, scratch), sink(dtau_dqd, scratch + 2));
}

template <class S>
void inverse_dynamics_derivatives(const KinematicsT<S>& kin, VectorInT<S> qd, VectorInT<S> qdd,
                                  BranchMatrixT<S>& dtau_dq, BranchMatrixT<S>& dtau_dqd) {
    require_model(in_derivatives, "matrix dtau_dq", dtau_dq.model().serial(), kin.model().serial());
    require_model(in_derivatives, "matrix dtau_dqd", dtau_dqd.model().serial(), kin.model().serial());
    const auto sink = [](BranchMatrixT<S>& A) { return BranchSink<S>{A.rows(), A.columns(), A.offset()}; };
    run(arguments<S>(kin, qd, qdd), sink(dtau_dq), sink(dtau_dqd));
}

#define CARDAN_INSTANTIATE(S)                                                                                       \
    template void inverse_dynamics_derivatives<S>(const KinematicsT<S>&, VectorInT<S>, VectorInT<S>, MatrixOutT<S>, \
                                                  MatrixOutT<S>);                                                   \
    template void inverse_dynamics_derivatives<S>(const KinematicsT<S>&, VectorInT<S>, VectorInT<S>,                \
                                                  BranchMatrixT<S>&, BranchMatrixT<S>&);
CARDAN_INSTANTIATE(double)
CARDAN_INSTANTIATE(Complex)
#undef CARDAN_INSTANTIATE

}  // namespace cardan
