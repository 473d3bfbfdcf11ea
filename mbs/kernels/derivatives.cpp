// Plain twin: tests/mbs/kernels/plain_dynamics.hpp
#include "mbs/kernels/derivatives.hpp"

#include "mbs/kernels/composites.hpp"
#include "mbs/kernels/detail/added_mass.hpp"
#include "mbs/kernels/registers/path_twists.hpp"

namespace cardan {

namespace {

// Rows of the branch besides the twists S_j = (w, u): Psi' = v x S and Psi'' = a x S + v x Psi' of the carrier's
// spatial velocity v and acceleration a, their linear parts at o_j.
enum BranchRows { psi1_w = 0, psi1_u = 3, psi2_w = 6, psi2_u = 9, scratch = 12 };

using Rates = KernelArrays::Rates;

// Motion of body k; returns Psi' and Psi'' of its coordinate.
CARDAN_INLINE Rates advance(const Model::Link& link, const KernelArrays::Frame* frame, std::ptrdiff_t k, double qd,
                            double qdd, KernelArrays::Motion* motion) {
    using P3 = Packed3<double>;
    P3 w = P3::zero(), al = P3::zero(), v = P3::zero(), a = P3::zero();
    if (link.parent >= 0) {
        const KernelArrays::Motion& carrier = motion[link.parent];
        w = carrier.w, al = carrier.al, v = carrier.v, a = carrier.a;
        if (!link.coincident) {
            const P3 arm = frame[k].o - frame[link.parent].o, sweep = cross(w, arm);
            v += sweep;
            a += cross(al, arm) + cross(w, sweep);
        }
    }
    const P3& e = frame[k].E[2];
    const P3 turned = cross(w, e), turned_twice = cross(al, e) + cross(w, turned);
    Rates rates;
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
        a += qdd * e + (2 * qd) * turned;
        v += qd * e;
    }
    motion[k] = {w, al, v, a};
    return rates;
}

// Momentum and force of body k alone, moments about its joint origin.
CARDAN_INLINE void own_load(const Model::Link& link, const KernelArrays::Frame& frame, const Packed33<double>& J,
                            const KernelArrays::Motion& motion, KernelArrays::Momentum& momentum,
                            KernelArrays::Load& load) {
    using P3 = Packed3<double>;
    if (link.massless) {
        momentum = {P3::zero(), {{P3::zero(), P3::zero(), P3::zero()}}};
        load = {P3::zero(), P3::zero()};
        return;
    }
    const P3 c = frame.r - frame.o, sweep = cross(motion.w, c);
    const double m = link.mass;
    momentum.p = m * (motion.v + sweep);
    momentum.G = minus_times_skew(binet(J), motion.w);  // sum m rho (w x rho)^T
    for (int j = 0; j < 3; ++j) momentum.G[j] += momentum.p(j) * c;
    load.F = m * (motion.a + cross(motion.al, c) + cross(motion.w, sweep));
    load.N = J * motion.al + cross(motion.w, J * motion.w) + cross(c, load.F);
}

// (tr G - G) x
CARDAN_INLINE Packed3<double> spin(const Packed33<double>& G, const Packed3<double>& x) {
    return (G[0](0) + G[1](1) + G[2](2)) * x - G * x;
}

// What row and column k of the derivatives need of the subtree of k, at its centre of mass C. A subtree that is carried
// by the twist Psi has the inertial forces I Psi'' and 2 B Psi', where B Psi = sum m w_Psi x x_dot.
struct Subtree {
    Packed3<double> C;
    Packed3<double> momentum, spin;  ///< I S_k
    Packed3<double> B_row;           ///< S_k . B Psi = B_row . w_Psi
    Packed3<double> force_q, moment_q, force_qd, moment_qd;
};

CARDAN_INLINE Subtree subtree_of(const Model::Link& link, const KernelArrays::Frame& frame,
                                 const KernelArrays::Inertia& body, const KernelArrays::Momentum& momentum,
                                 const KernelArrays::Load& load, const Rates& rates) {
    using P3 = Packed3<double>;
    const P3& e = frame.E[2];
    const P3 arm = body.C - frame.o;
    const P3 w = link.revolute ? e : P3::zero(), v = link.revolute ? cross(e, arm) : e;
    Packed33<double> G = momentum.G;
    for (int j = 0; j < 3; ++j) G[j] -= momentum.p(j) * arm;
    const Packed33<double> Gt = transpose(G);
    const P3 &p = momentum.p, moment = load.N - cross(arm, load.F);
    const P3 v1 = rates.psi1_u + cross(rates.psi1_w, arm), v2 = rates.psi2_u + cross(rates.psi2_w, arm);
    const P3 force_q = 2 * cross(rates.psi1_w, p) + body.M * v2 + cross(w, load.F);
    const P3 moment_q = 2 * spin(Gt, rates.psi1_w) + spin(body.P, rates.psi2_w) + cross(w, moment) + cross(v, load.F);
    const P3 force_qd = 2 * (cross(w, p) + body.M * v1);
    const P3 moment_qd = 2 * (spin(Gt, w) + spin(body.P, rates.psi1_w));
    return {body.C, body.M * v, spin(body.P, w), cross(p, v) + spin(G, w), force_q, moment_q, force_qd, moment_qd};
}

// The products of subtree k with four coordinates on its path.
CARDAN_INLINE void branch_products(const PathTwists<double>& path, std::ptrdiff_t blocks, const Subtree& s,
                                   Packed3<double>* row_q, Packed3<double>* row_qd, Packed3<double>* column_q,
                                   Packed3<double>* column_qd) {
    using Columns = Packed3<double>;
    const Columns cx = broadcast<0>(s.C), cy = broadcast<1>(s.C), cz = broadcast<2>(s.C);
    const auto about_o = [&](std::ptrdiff_t j, const Packed3<double>& force, const Packed3<double>& moment,
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
    const auto fixed = [&](std::ptrdiff_t j, int first_row, const Packed3<double>& v) CARDAN_INLINE_LAMBDA {
        return times(broadcast<0>(v), path.row(first_row)[j]) + times(broadcast<1>(v), path.row(first_row + 1)[j]) +
               times(broadcast<2>(v), path.row(first_row + 2)[j]);
    };
    const Packed3<double> B_row = 2 * s.B_row, momentum = 2 * s.momentum;
    for (std::ptrdiff_t j = 0; j < blocks; ++j) {
        Columns moment[3];
        about_o(j, s.momentum, s.spin, moment);
        row_q[j] = fixed(j, psi1_w, B_row) + product(j, psi2_w, moment) + fixed(j, psi2_u, s.momentum);
        row_qd[j] =
            fixed(j, PathTwists<double>::w_rows, B_row) + 2 * product(j, psi1_w, moment) + fixed(j, psi1_u, momentum);
        about_o(j, s.force_q, s.moment_q, moment);
        column_q[j] = product(j, PathTwists<double>::w_rows, moment) + fixed(j, PathTwists<double>::u_rows, s.force_q);
        about_o(j, s.force_qd, s.moment_qd, moment);
        column_qd[j] =
            product(j, PathTwists<double>::w_rows, moment) + fixed(j, PathTwists<double>::u_rows, s.force_qd);
    }
}

CARDAN_INLINE void set_rates(const PathTwists<double>& path, std::ptrdiff_t column, const Rates& rates) {
    path.set(psi1_w, column, rates.psi1_w);
    path.set(psi1_u, column, rates.psi1_u);
    path.set(psi2_w, column, rates.psi2_w);
    path.set(psi2_u, column, rates.psi2_u);
}

struct Arguments {
    int n;
    const Model::Link* links;
    const KernelArrays::Frame* frame;
    const KernelArrays::Inertia* composite;
    const Packed33<double>* J;
    KernelArrays::Motion* motion;
    KernelArrays::Momentum* momentum;
    KernelArrays::Load* load;
    Rates* rates;
    PathTwists<double> path;
    const double *qd, *qdd;
};

template <class Sink>
CARDAN_INLINE void differentiate(const Arguments& x, const Sink& by_q, const Sink& by_qd) {
    for (int k = 0; k < x.n; ++k) {
        x.rates[k] = advance(x.links[k], x.frame, k, x.qd[k], x.qdd[k], x.motion);
        own_load(x.links[k], x.frame[k], x.J[k], x.motion[k], x.momentum[k], x.load[k]);
    }
    for (int k = x.n - 1; k > 0; --k) {
        const int p = x.links[k].parent;
        if (p < 0) continue;
        const Packed3<double> arm = x.frame[k].o - x.frame[p].o;
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
            const Subtree s = subtree_of(x.links[k], x.frame[k], x.composite[k], x.momentum[k], x.load[k], x.rates[k]);
            branch_products(x.path, PathTwists<double>::blocks(x.links[k].depth), s, by_q.row_of(k), by_qd.row_of(k),
                            by_q.column_of(k), by_qd.column_of(k));
            by_q.written(k);
            by_qd.written(k);
        }
        first = end;
    }
}

CARDAN_VECTORISED void run(const Arguments& x, const DenseSink<double>& by_q, const DenseSink<double>& by_qd) {
    differentiate(x, by_q, by_qd);
}
CARDAN_VECTORISED void run(const Arguments& x, const BranchSink& by_q, const BranchSink& by_qd) {
    differentiate(x, by_q, by_qd);
}

constexpr const char* in_derivatives = "derivatives of the inverse dynamics";

Arguments arguments(const Kinematics& kin, VectorIn qd, VectorIn qdd) {
    require_size(in_derivatives, "qd", qd, kin.model().size());
    require_size(in_derivatives, "qdd", qdd, kin.model().size());
    composites(kin);
    KernelArrays& ws = kin.arrays();
    return {kin.model().size(), kin.model().links().data(),
            ws.frame.data(),    ws.composite.data(),
            ws.J.data(),        ws.motion.data(),
            ws.momentum.data(), ws.load.data(),
            ws.rates.data(),    PathTwists<double>(ws.branch.data(), ws.stride),
            qd.data(),          qdd.data()};
}

Vec6 column(const Packed3<double>& angular, const Packed3<double>& linear) {
    return (Vec6() << angular.vector(), linear.vector()).finished();
}

// What added mass adds, after the rest. With I, B and f of the subtree of m, S the twists:
//   row m:     S_m . (I Psi''_j + 2 B Psi'_j)                  2 S_m . (I Psi'_j + B S_j)
//   column m:  S_j . (I Psi''_m + 2 B Psi'_m + S_m x* f)       2 S_j . (I Psi'_m + B S_m)
template <class Add>
void add_added_mass_derivatives(const Kinematics& kin, const Add& by_q, const Add& by_qd) {
    KernelArrays& ws = kin.arrays();
    for (KernelArrays::Entraining& at : ws.entraining) {
        at.B.setZero();
        at.f.setZero();
        if (at.own < 0) continue;
        const KernelArrays::Motion& motion = entry(ws.motion, at.body);
        const Mat6 I = own_added_mass(kin, entry(kin.model().added_masses(), at.own));
        at.B = coriolis_inertia<double>(I, twist_column<double>(motion));
        at.f = added_mass_force<double>(I, motion);
    }
    for (std::size_t i = ws.entraining.size(); i-- > 0;) {
        const KernelArrays::Entraining& at = ws.entraining[i];
        const int m = at.body;
        const Packed3<double> o = entry(ws.frame, m).o;
        if (at.parent >= 0) {
            KernelArrays::Entraining& parent = entry(ws.entraining, at.parent);
            const Mat6 X = twist_shift<double>((o - entry(ws.frame, parent.body).o).vector());
            parent.B += X.transpose() * at.B * X;
            parent.f += X.transpose() * at.f;
        }
        const Rates& own = entry(ws.rates, m);
        const Vec6 S = twist_column<double>(kin, m, o.vector()), S1 = column(own.psi1_w, own.psi1_u),
                   S2 = column(own.psi2_w, own.psi2_u);
        const Vec6 row_I = at.I * S, row_B = 2 * (at.B.transpose() * S);
        const Vec6 column_q = at.I * S2 + 2 * (at.B * S1) + carried<double>(S, at.f);
        const Vec6 column_qd = 2 * (at.I * S1 + at.B * S);
        for (int j = m; j >= 0; j = own_parent(kin.model(), j)) {
            const Rates& rates = entry(ws.rates, j);
            const Packed3<double> arm = o - entry(ws.frame, j).o;
            const Vec6 T = twist_column<double>(kin, j, o.vector());
            const Vec6 T1 = column(rates.psi1_w, rates.psi1_u + cross(rates.psi1_w, arm)),
                       T2 = column(rates.psi2_w, rates.psi2_u + cross(rates.psi2_w, arm));
            by_q(m, j, row_I.dot(T2) + row_B.dot(T1));
            by_qd(m, j, 2 * row_I.dot(T1) + row_B.dot(T));
            if (j == m) continue;
            by_q(j, m, T.dot(column_q));
            by_qd(j, m, T.dot(column_qd));
        }
    }
}

}  // namespace

void inverse_dynamics_derivatives(const Kinematics& kin, VectorIn qd, VectorIn qdd, MatrixOut dtau_dq,
                                  MatrixOut dtau_dqd) {
    const Arguments x = arguments(kin, qd, qdd);
    require_size(in_derivatives, "dtau_dq", dtau_dq, x.n, x.n);
    require_size(in_derivatives, "dtau_dqd", dtau_dqd, x.n, x.n);
    const auto sink = [&](MatrixOut& A, int row) {
        return DenseSink<double>{x.links, x.n, A.data(), A.outerStride(), x.path.row(row), x.path.row(row + 1)};
    };
    run(x, sink(dtau_dq, scratch), sink(dtau_dqd, scratch + 2));
    const auto add = [](MatrixOut& A) { return [&A](int a, int b, double value) { A(a, b) += value; }; };
    add_added_mass_derivatives(kin, add(dtau_dq), add(dtau_dqd));
}

void inverse_dynamics_derivatives(const Kinematics& kin, VectorIn qd, VectorIn qdd, BranchMatrix& dtau_dq,
                                  BranchMatrix& dtau_dqd) {
    require_model(in_derivatives, "matrix dtau_dq", dtau_dq.model().serial(), kin.model().serial());
    require_model(in_derivatives, "matrix dtau_dqd", dtau_dqd.model().serial(), kin.model().serial());
    const auto sink = [](BranchMatrix& A) { return BranchSink(A); };
    run(arguments(kin, qd, qdd), sink(dtau_dq), sink(dtau_dqd));
    const auto add = [](BranchMatrix& A) { return [&A](int a, int b, double value) { A.add(a, b, value); }; };
    add_added_mass_derivatives(kin, add(dtau_dq), add(dtau_dqd));
}

}  // namespace cardan
