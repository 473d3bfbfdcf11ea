#include "mbs/dynamics.hpp"
#include "mbs/error.hpp"

#include <algorithm>

namespace cardan {

namespace {

// Inertia of a body alone about its joint origin.
CARDAN_INLINE void rigid(const Model::Link& link, const Workspace::Frame& frame, const Packed33<double>& J,
                         Packed33<double>& A, Packed33<double>& C, Packed33<double>& M) {
    using P3 = Packed3<double>;
    if (link.massless) {
        A = C = M = {{P3::zero(), P3::zero(), P3::zero()}};
        return;
    }
    const double m = link.mass;
    const P3 c = frame.r - frame.o, mc = m * c;
    M = {{P3::of(m, 0.0, 0.0), P3::of(0.0, m, 0.0), P3::of(0.0, 0.0, m)}};
    // -m c^ (force of an angular acceleration) and J - m c^ c^
    C = {{P3::of(0.0, -mc(2), mc(1)), P3::of(mc(2), 0.0, -mc(0)), P3::of(-mc(1), mc(0), 0.0)}};
    const double square = dot(mc, c);
    A = J;
    A[0] += P3::of(square, 0.0, 0.0) - mc(0) * c;
    A[1] += P3::of(0.0, square, 0.0) - mc(1) * c;
    A[2] += P3::of(0.0, 0.0, square) - mc(2) * c;
}

// X - u v^T / D
CARDAN_INLINE void subtract(Packed33<double>& X, const Packed3<double>& u, const Packed3<double>& v_over_D) {
    X[0] -= times(u, broadcast<0>(v_over_D));
    X[1] -= times(u, broadcast<1>(v_over_D));
    X[2] -= times(u, broadcast<2>(v_over_D));
}

}  // namespace

ForwardDynamics::ForwardDynamics(const Model& model) : ForwardDynamics(model, model.coordinates().driven()) {}

ForwardDynamics::ForwardDynamics(const Model& model, std::vector<bool> driven)
    : model_(&model), driven_(driven.begin(), driven.end()) {
    const int n = model.size();
    if (driven_.size() != static_cast<std::size_t>(n))
        throw InputError("forward dynamics", "number of driven flags", driven_.size(), text(n, ", one per coordinate"));
    armature_diagonal_.setZero(n);
    for (Vector* x : {&residual_, &correction_, &reaction_, &zero_}) x->setZero(n);
    articulated_.resize(static_cast<std::size_t>(n));
    // An armature over several coordinates is split: its diagonal goes into the recursion, which keeps every pivot
    // positive even where only the armature has inertia; the rest follows by a low-rank correction (Woodbury). Beside
    // such a one a negative armature goes into the correction as a whole: the recursion works on more than the metric.
    const auto& armatures = model.armatures();
    const bool coupled = std::any_of(armatures.begin(), armatures.end(), [](auto& x) { return x.spin.size() > 1; });
    for (const Model::Spin& armature : armatures) {
        const bool in_recursion = armature.inertia > 0 || !coupled;
        for (const auto& [a, s] : armature.spin) {
            if (in_recursion) armature_diagonal_(a) += armature.inertia * s * s;
            if ((armature.spin.size() > 1 || !in_recursion) && !is_driven(a) &&
                std::find(support_.begin(), support_.end(), a) == support_.end())
                support_.push_back(a);
        }
    }
    const auto r = static_cast<Eigen::Index>(support_.size());
    coupling_.setZero(r, r);
    for (const Model::Spin& armature : armatures)
        for (const auto& [a, sa] : armature.spin)
            for (const auto& [b, sb] : armature.spin) {
                const bool in_recursion = a == b && (armature.inertia > 0 || !coupled);
                const auto ia = std::find(support_.begin(), support_.end(), a);
                const auto ib = std::find(support_.begin(), support_.end(), b);
                if (!in_recursion && ia != support_.end() && ib != support_.end())
                    coupling_(ia - support_.begin(), ib - support_.begin()) += armature.inertia * sa * sb;
            }
    support_solution_.setZero(n, r);
    support_reaction_.setZero(n, r);
    capacity_.setZero(r, r);
    support_qdd_.setZero(r);
    support_load_.setZero(r);
    support_correction_.setZero(r);
    capacity_lu_ = Eigen::PartialPivLU<Matrix>(r);
}

struct ForwardDynamics::Arrays {
    std::ptrdiff_t n;
    const Model::Link* links;
    const int* order;
    const Workspace::Frame* frame;
    const Packed33<double>* J;
    const double* armature;
    const char* held;
    Articulated* body;

    // Articulated inertias, tip to base, deepest bodies first: those of parallel branches do not wait for each other.
    // The yield of a joint, U U^T / D, is taken away after the shift to the parent's joint origin, so that the division
    // goes on meanwhile.                                                              [Featherstone 2008, section 7.3]
    CARDAN_INLINE void factorise() const {
        for (std::ptrdiff_t k = 0; k < n; ++k) rigid(links[k], frame[k], J[k], body[k].A, body[k].C, body[k].M);
        for (std::ptrdiff_t i = n - 1; i >= 0; --i) {
            const std::ptrdiff_t k = order[i];
            Articulated& own = body[k];
            const Packed3<double>& e = frame[k].E[2];
            if (links[k].revolute) {
                own.U_angular = own.A * e;
                own.U_linear = own.C * e;
            } else {
                own.U_angular = transpose(own.C) * e;
                own.U_linear = own.M * e;
            }
            own.D = dot(e, links[k].revolute ? own.U_angular : own.U_linear) + armature[k];
            if (links[k].parent < 0) continue;
            Articulated& parent = body[links[k].parent];
            Packed33<double> A = own.A, C = own.C, M = own.M;
            Packed3<double> U_angular = own.U_angular;
            if (!links[k].coincident) {
                const Packed3<double> arm = frame[k].o - frame[links[k].parent].o;
                A += Packed33<double>{{cross(arm, C[0]), cross(arm, C[1]), cross(arm, C[2])}};
                C += minus_times_skew(M, arm);
                A += minus_times_skew(transpose(C), arm);
                U_angular += cross(arm, own.U_linear);
            }
            parent.A += A;
            parent.C += C;
            parent.M += M;
            if (held[k]) continue;
            const double yield = 1 / own.D;
            const Packed3<double> angular = yield * U_angular, linear = yield * own.U_linear;
            subtract(parent.A, U_angular, angular);
            subtract(parent.C, own.U_linear, angular);
            subtract(parent.M, own.U_linear, linear);
        }
    }

    // Solves for the motion that the forces Q produce from rest. reaction: what held joints carry.
    CARDAN_INLINE void solve(const double* Q, double* qdd, double* reaction) const {
        using P3 = Packed3<double>;
        for (std::ptrdiff_t k = 0; k < n; ++k) body[k].force = body[k].moment = P3::zero();
        for (std::ptrdiff_t k = n - 1; k >= 0; --k) {
            Articulated& own = body[k];
            const P3& e = frame[k].E[2];
            reaction[k] = dot(e, links[k].revolute ? own.moment : own.force);
            qdd[k] = held[k] ? 0.0 : (Q[k] - reaction[k]) / own.D;
            if (links[k].parent < 0) continue;
            const P3 force = own.force + qdd[k] * own.U_linear, moment = own.moment + qdd[k] * own.U_angular;
            Articulated& parent = body[links[k].parent];
            parent.force += force;
            parent.moment += moment;
            if (!links[k].coincident) parent.moment += cross(frame[k].o - frame[links[k].parent].o, force);
        }
        for (std::ptrdiff_t k = 0; k < n; ++k) {
            Articulated& own = body[k];
            const P3& e = frame[k].E[2];
            P3 angular = P3::zero(), linear = P3::zero();
            if (links[k].parent >= 0) {
                const Articulated& parent = body[links[k].parent];
                angular = parent.angular, linear = parent.linear;
                if (!links[k].coincident) linear += cross(angular, frame[k].o - frame[links[k].parent].o);
            }
            const double carried = dot(own.U_angular, angular) + dot(own.U_linear, linear);
            if (held[k])
                reaction[k] += carried;
            else
                qdd[k] -= carried / own.D;
            (links[k].revolute ? angular : linear) += qdd[k] * e;
            own.angular = angular, own.linear = linear;
        }
    }
};

CARDAN_VECTORISED void ForwardDynamics::factorise(const Arrays& arrays) {
    arrays.factorise();
}

CARDAN_VECTORISED void ForwardDynamics::solve_from_rest(const Arrays& arrays, const double* Q, double* qdd,
                                                        double* reaction) {
    arrays.solve(Q, qdd, reaction);
}

void ForwardDynamics::solve(const Kinematics& kin, VectorIn qd, VectorIn Q, VectorOut qdd, VectorOut actuator) {
    // What the motion needs without the accelerations of the free coordinates; the rest they produce from rest.
    Workspace& ws = kin.workspace();
    const Eigen::Index n = model_->size();
    assert(&kin.model() == model_ && Q.size() == n && qdd.size() == n && actuator.size() == n);
    for (Eigen::Index k = 0; k < n; ++k)
        if (!driven_[static_cast<std::size_t>(k)]) qdd(k) = 0;
    inverse_dynamics<double>(kin, qd, qdd, residual_);
    body_inertias(kin);
    residual_ = Q - residual_;
    const Arrays arrays{n,
                        model_->links().data(),
                        model_->by_depth().data(),
                        ws.frame.data(),
                        ws.J.data(),
                        armature_diagonal_.data(),
                        driven_.data(),
                        articulated_.data()};
    factorise(arrays);
    solve_from_rest(arrays, residual_.data(), correction_.data(), reaction_.data());

    if (const auto r = static_cast<Eigen::Index>(support_.size()); r > 0) {
        // (g0 + W X W^T) qdd = rhs:  qdd = y - Y (1 + X W^T Y)^-1 X W^T y
        for (Eigen::Index j = 0; j < r; ++j) {
            zero_(support_[static_cast<std::size_t>(j)]) = 1;
            solve_from_rest(arrays, zero_.data(), support_solution_.col(j).data(), support_reaction_.col(j).data());
            zero_(support_[static_cast<std::size_t>(j)]) = 0;
        }
        for (Eigen::Index i = 0; i < r; ++i) support_qdd_(i) = correction_(support_[static_cast<std::size_t>(i)]);
        capacity_.setIdentity();
        for (Eigen::Index i = 0; i < r; ++i)
            for (Eigen::Index j = 0; j < r; ++j)
                for (Eigen::Index l = 0; l < r; ++l)
                    capacity_(i, j) += coupling_(i, l) * support_solution_(support_[static_cast<std::size_t>(l)], j);
        support_load_.noalias() = coupling_ * support_qdd_;
        capacity_lu_.compute(capacity_);
        support_correction_.noalias() = capacity_lu_.solve(support_load_);
        correction_.noalias() -= support_solution_ * support_correction_;
        reaction_.noalias() -= support_reaction_ * support_correction_;
    }
    actuator.setZero();
    for (Eigen::Index k = 0; k < n; ++k)
        if (driven_[static_cast<std::size_t>(k)])
            actuator(k) = reaction_(k) - residual_(k);
        else
            qdd(k) = correction_(k);
    // Armatures that couple a driven with a free coordinate.
    for (const Model::Spin& armature : model_->armatures())
        for (const auto& [a, sa] : armature.spin)
            for (const auto& [b, sb] : armature.spin)
                if (is_driven(a) && !is_driven(b)) actuator(a) += armature.inertia * sa * sb * correction_(b);
}

}  // namespace cardan
