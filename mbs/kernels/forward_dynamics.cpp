// Plain twin: tests/mbs/kernels/plain_dynamics.hpp
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/detail/added_mass.hpp"
#include "mbs/kernels/detail/articulated.hpp"

#include <algorithm>

namespace cardan {

namespace {

// Inertia of a body alone about its joint origin.
CARDAN_INLINE void rigid(const Model::Link& link, const KernelArrays::Frame& frame, const Packed33<double>& J,
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

ForwardDynamics::ForwardDynamics(const ForwardDynamics& other) = default;
ForwardDynamics::ForwardDynamics(ForwardDynamics&& other) noexcept = default;
ForwardDynamics& ForwardDynamics::operator=(const ForwardDynamics& other) = default;
ForwardDynamics& ForwardDynamics::operator=(ForwardDynamics&& other) noexcept = default;
ForwardDynamics::~ForwardDynamics() = default;

ForwardDynamics::ForwardDynamics(const Model& model) : ForwardDynamics(model, model.coordinates().driven()) {}

ForwardDynamics::ForwardDynamics(const Model& model, std::vector<bool> driven)
    : model_(&model), driven_(driven.begin(), driven.end()) {
    const int n = model.size();
    if (driven_.size() != static_cast<std::size_t>(n))
        throw InputError("forward dynamics", "number of driven flags", driven_.size(), text(n, ", one per coordinate"));
    armature_diagonal_.setZero(n);
    for (Vector* x : {&residual_, &correction_, &reaction_}) x->setZero(n);
    articulated_.resize(static_cast<std::size_t>(n));
    water_.resize(model.added_masses().size());
    const auto& armatures = model.armatures();
    find_support(std::any_of(armatures.begin(), armatures.end(), [](auto& x) { return x.spin.size() > 1; }));
    find_path();
}

// An armature over several coordinates is split: its diagonal goes into the recursion, which keeps every pivot positive
// even where only the armature has inertia; the rest follows by a low-rank correction (Woodbury). Beside such a one a
// negative armature goes into the correction as a whole: the recursion works on more than the metric.
void ForwardDynamics::find_support(bool coupled) {
    const auto in_recursion = [&](const Model::Spin& armature) { return armature.inertia > 0 || !coupled; };
    for (const Model::Spin& armature : model_->armatures())
        for (const auto& [a, s] : armature.spin) {
            if (in_recursion(armature)) armature_diagonal_(a) += armature.inertia * s * s;
            if ((armature.spin.size() > 1 || !in_recursion(armature)) && !is_driven(a) &&
                std::find(support_.begin(), support_.end(), a) == support_.end())
                support_.push_back(a);
        }
    const auto r = std::ssize(support_);
    coupling_.setZero(r, r);
    for (const Model::Spin& armature : model_->armatures())
        for (const auto& [a, sa] : armature.spin)
            for (const auto& [b, sb] : armature.spin) {
                if (a == b && in_recursion(armature)) continue;
                const auto ia = std::find(support_.begin(), support_.end(), a);
                const auto ib = std::find(support_.begin(), support_.end(), b);
                if (ia != support_.end() && ib != support_.end())
                    coupling_(ia - support_.begin(), ib - support_.begin()) += armature.inertia * sa * sb;
            }
    for (Matrix* m : {&support_inverse_, &capacity_}) m->setZero(r, r);
    for (Vector* v : {&support_qdd_, &support_load_, &support_correction_}) v->setZero(r);
    capacity_lu_ = Eigen::PartialPivLU<Matrix>(r);
}

void ForwardDynamics::find_path() {
    std::vector<int> place(static_cast<std::size_t>(model_->size()), -1);
    for (const int support : support_)
        for (int k = support; k >= 0; k = entry(model_->links(), k).parent) entry(place, k) = 0;
    for (int k = 0; k < model_->size(); ++k) {
        if (entry(place, k) < 0) continue;
        entry(place, k) = static_cast<int>(path_.size());
        const int parent = entry(model_->links(), k).parent;
        path_.push_back({k, parent < 0 ? -1 : entry(place, parent)});
    }
    for (const int support : support_) at_.push_back(entry(place, support));
    on_path_.resize(path_.size() * std::max<std::size_t>(1, support_.size()));
}

struct ForwardDynamics::Arrays {
    std::ptrdiff_t n;
    const Model::Link* links;
    const int* order;
    const KernelArrays::Frame* frame;
    const Packed33<double>* J;
    const double* armature;
    const char* held;
    Articulated* body;
    const Path* path;
    std::ptrdiff_t path_length;
    OnPath* on_path;
    const AddedMass* water;
    std::ptrdiff_t waters;

    // Articulated inertias, tip to base, deepest bodies first: those of parallel branches do not wait for each other.
    // The yield of a joint, U U^T / D, is taken away after the shift to the parent's joint origin, so that the division
    // goes on meanwhile.                                                              [Featherstone 2008, section 7.3]
    CARDAN_INLINE void factorise() const {
        for (std::ptrdiff_t k = 0; k < n; ++k) rigid(links[k], frame[k], J[k], body[k].A, body[k].C, body[k].M);
        for (std::ptrdiff_t i = 0; i < waters; ++i) {
            Articulated& own = body[water[i].body];
            own.A += water[i].A;
            own.C += water[i].C;
            own.M += water[i].M;
        }
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
            own.yield = 1 / (dot(e, links[k].revolute ? own.U_angular : own.U_linear) + armature[k]);
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
            const Packed3<double> angular = own.yield * U_angular, linear = own.yield * own.U_linear;
            subtract(parent.A, U_angular, angular);
            subtract(parent.C, own.U_linear, angular);
            subtract(parent.M, own.U_linear, linear);
        }
    }

    // The motion that the forces Q produce from rest, by two sweeps through the levels of the tree, so that parallel
    // branches do not wait for each other. reaction: what held joints carry.
    CARDAN_INLINE void backward(const double* Q, double* qdd, double* reaction) const {
        using P3 = Packed3<double>;
        for (std::ptrdiff_t k = 0; k < n; ++k) body[k].force = body[k].moment = P3::zero();
        for (std::ptrdiff_t i = n - 1; i >= 0; --i) {
            const std::ptrdiff_t k = order[i];
            Articulated& own = body[k];
            reaction[k] = dot(frame[k].E[2], links[k].revolute ? own.moment : own.force);
            qdd[k] = held[k] ? 0.0 : (Q[k] - reaction[k]) * own.yield;
            if (links[k].parent < 0) continue;
            const P3 force = own.force + qdd[k] * own.U_linear, moment = own.moment + qdd[k] * own.U_angular;
            Articulated& parent = body[links[k].parent];
            parent.force += force;
            parent.moment += moment;
            if (!links[k].coincident) parent.moment += cross(frame[k].o - frame[links[k].parent].o, force);
        }
    }
    CARDAN_INLINE void forward(double* qdd, double* reaction) const {
        using P3 = Packed3<double>;
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            const std::ptrdiff_t k = order[i];
            Articulated& own = body[k];
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
                qdd[k] -= carried * own.yield;
            (links[k].revolute ? angular : linear) += qdd[k] * frame[k].E[2];
            own.angular = angular, own.linear = linear;
        }
    }

    // Both sweeps restricted to the path to the coupled coordinates, for several loads side by side.
    CARDAN_INLINE void backward_on_path(std::ptrdiff_t loads) const {
        using P3 = Packed3<double>;
        for (std::ptrdiff_t i = 0; i < path_length * loads; ++i) on_path[i].force = on_path[i].moment = P3::zero();
        for (std::ptrdiff_t i = path_length - 1; i >= 0; --i) {
            const std::ptrdiff_t k = path[i].body;
            const Articulated& joint = body[k];
            for (std::ptrdiff_t j = 0; j < loads; ++j) {
                OnPath& own = on_path[i * loads + j];
                own.reaction = dot(frame[k].E[2], links[k].revolute ? own.moment : own.force);
                own.qdd = held[k] ? 0.0 : (own.qdd - own.reaction) * joint.yield;
                if (path[i].parent < 0) continue;
                OnPath& parent = on_path[path[i].parent * loads + j];
                const P3 force = own.force + own.qdd * joint.U_linear;
                parent.force += force;
                parent.moment += own.moment + own.qdd * joint.U_angular;
                if (!links[k].coincident) parent.moment += cross(frame[k].o - frame[links[k].parent].o, force);
            }
        }
    }
    CARDAN_INLINE void forward_on_path(std::ptrdiff_t loads) const {
        using P3 = Packed3<double>;
        for (std::ptrdiff_t i = 0; i < path_length; ++i) {
            const std::ptrdiff_t k = path[i].body;
            const Articulated& joint = body[k];
            for (std::ptrdiff_t j = 0; j < loads; ++j) {
                OnPath& own = on_path[i * loads + j];
                P3 angular = P3::zero(), linear = P3::zero();
                if (path[i].parent >= 0) {
                    const OnPath& parent = on_path[path[i].parent * loads + j];
                    angular = parent.angular, linear = parent.linear;
                    if (!links[k].coincident) linear += cross(angular, frame[k].o - frame[links[k].parent].o);
                }
                if (!held[k]) own.qdd -= (dot(joint.U_angular, angular) + dot(joint.U_linear, linear)) * joint.yield;
                (links[k].revolute ? angular : linear) += own.qdd * frame[k].E[2];
                own.angular = angular, own.linear = linear;
            }
        }
    }
};

CARDAN_VECTORISED void ForwardDynamics::factorise(const Arrays& arrays) {
    arrays.factorise();
}
CARDAN_VECTORISED void ForwardDynamics::backward(const Arrays& arrays, const double* Q, double* qdd, double* reaction) {
    arrays.backward(Q, qdd, reaction);
}
CARDAN_VECTORISED void ForwardDynamics::forward(const Arrays& arrays, double* qdd, double* reaction) {
    arrays.forward(qdd, reaction);
}
CARDAN_VECTORISED void ForwardDynamics::backward_on_path(const Arrays& arrays, std::ptrdiff_t loads) {
    arrays.backward_on_path(loads);
}
CARDAN_VECTORISED void ForwardDynamics::forward_on_path(const Arrays& arrays, std::ptrdiff_t loads) {
    arrays.forward_on_path(loads);
}

// After the backward sweep: loads on the coupled coordinates that stand for what the recursion left out,
//   (g_0 + W X W^T) qdd = Q:   g_0 qdd = Q - W (1 + X W^T g_0^-1 W)^-1 X W^T g_0^-1 Q.
// Only the path from the base to these coordinates is swept.                                             [Woodbury]
void ForwardDynamics::couple(const Arrays& arrays) {
    const auto r = std::ssize(support_);
    // What the path holds for coordinate i of the support, under load j of several.
    const auto state = [&](Eigen::Index i, Eigen::Index j, Eigen::Index loads) -> OnPath& {
        return entry(on_path_, entry(at_, i) * loads + j);
    };
    for (OnPath& x : on_path_) x.qdd = 0;
    for (Eigen::Index j = 0; j < r; ++j) state(j, j, r).qdd = 1;
    backward_on_path(arrays, r);
    forward_on_path(arrays, r);
    for (Eigen::Index i = 0; i < r; ++i)
        for (Eigen::Index j = 0; j < r; ++j) support_inverse_(i, j) = state(i, j, r).qdd;

    for (std::size_t i = 0; i < path_.size(); ++i) on_path_[i].qdd = correction_(path_[i].body);
    forward_on_path(arrays, 1);
    for (Eigen::Index i = 0; i < r; ++i) support_qdd_(i) = state(i, 0, 1).qdd;
    capacity_.setIdentity();
    capacity_ += coupling_.lazyProduct(support_inverse_);
    capacity_lu_.compute(capacity_);
    support_load_.noalias() = coupling_ * support_qdd_;
    support_correction_.noalias() = capacity_lu_.solve(support_load_);

    for (std::size_t i = 0; i < path_.size(); ++i) on_path_[i].qdd = 0;
    for (Eigen::Index i = 0; i < r; ++i) state(i, 0, 1).qdd = -support_correction_(i);
    backward_on_path(arrays, 1);
    for (std::size_t i = 0; i < path_.size(); ++i) {
        correction_(path_[i].body) += on_path_[i].qdd;
        reaction_(path_[i].body) += on_path_[i].reaction;
    }
}

void ForwardDynamics::solve(const Kinematics& kin, VectorIn qd, VectorIn Q, VectorOut qdd, VectorOut actuator) {
    // (The inverse dynamics checks the size of qd.) What the motion needs without the accelerations of the free
    // coordinates; the rest they produce from rest.
    KernelArrays& ws = kin.arrays();
    const Eigen::Index n = model_->size();
    require_model("forward dynamics", "kinematics", kin.model().serial(), model_->serial());
    require_size("forward dynamics", "Q", Q, n);
    require_size("forward dynamics", "qdd", qdd, n);
    require_size("forward dynamics", "actuator", actuator, n);
    for (Eigen::Index k = 0; k < n; ++k)
        if (!entry(driven_, k)) qdd(k) = 0;
    inverse_dynamics<double>(kin, qd, qdd, residual_);
    body_inertias(kin);
    residual_ = Q - residual_;
    for (std::size_t i = 0; i < water_.size(); ++i) {
        const Model::AddedMass& water = model_->added_masses()[i];
        const Mat6 I = own_added_mass(kin, water);
        using P33 = Packed33<double>;
        water_[i] = {water.body, P33::of(Mat3(I.topLeftCorner<3, 3>())), P33::of(Mat3(I.bottomLeftCorner<3, 3>())),
                     P33::of(Mat3(I.bottomRightCorner<3, 3>()))};
    }
    const Arrays arrays{n,
                        model_->links().data(),
                        model_->by_depth().data(),
                        ws.frame.data(),
                        ws.J.data(),
                        armature_diagonal_.data(),
                        driven_.data(),
                        articulated_.data(),
                        path_.data(),
                        std::ssize(path_),
                        on_path_.data(),
                        water_.data(),
                        std::ssize(water_)};
    factorise(arrays);
    backward(arrays, residual_.data(), correction_.data(), reaction_.data());
    if (!support_.empty()) couple(arrays);
    forward(arrays, correction_.data(), reaction_.data());
    actuator.setZero();
    for (Eigen::Index k = 0; k < n; ++k)
        if (entry(driven_, k))
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
