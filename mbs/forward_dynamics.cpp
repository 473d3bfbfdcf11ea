#include "mbs/dynamics.hpp"
#include "mbs/error.hpp"

#include <algorithm>

namespace cardan {

namespace {

std::vector<bool> default_roles(const Model& model) {
    std::vector<bool> driven;
    for (const CoordinateInfo& row : model.coordinates()) driven.push_back(row.role == CoordinateRole::driven);
    return driven;
}

// Spatial inertia [angular; linear] about the joint origin, base axes.
Mat6 spatial_inertia(const Workspace& ws, const Model::Body& body, std::size_t i) {
    const Mat3 c = skew<double>(ws.r[i] - ws.o[i]);
    const double m = body.inertia.mass;
    Mat6 I;
    I.topLeftCorner<3, 3>() = ws.E[i] * body.J * ws.E[i].transpose() - m * c * c;
    I.topRightCorner<3, 3>() = m * c;
    I.bottomLeftCorner<3, 3>() = -m * c;
    I.bottomRightCorner<3, 3>() = m * Mat3::Identity();
    return I;
}

// Adds a spatial inertia about a point at `arm` from the new reference point.
void add_shifted(Mat6& target, const Mat6& I, const Vec3& arm) {
    const Mat3 x = skew<double>(arm);
    const Mat3 A = I.topLeftCorner<3, 3>(), B = I.topRightCorner<3, 3>(), M = I.bottomRightCorner<3, 3>();
    const Mat3 Bs = B + x * M;
    target.topLeftCorner<3, 3>() += A - B * x + x * B.transpose() - x * M * x;
    target.topRightCorner<3, 3>() += Bs;
    target.bottomLeftCorner<3, 3>() += Bs.transpose();
    target.bottomRightCorner<3, 3>() += M;
}

int part(const Model::Body& body) {
    return body.revolute ? 0 : 3;
}

}  // namespace

ForwardDynamics::ForwardDynamics(const Model& model) : ForwardDynamics(model, default_roles(model)) {}

ForwardDynamics::ForwardDynamics(const Model& model, std::vector<bool> driven)
    : model_(&model), driven_(std::move(driven)) {
    const int n = model.size();
    if (driven_.size() != static_cast<std::size_t>(n))
        throw InputError("forward dynamics", "number of driven flags", driven_.size(), text(n, ", one per coordinate"));
    armature_diagonal_.setZero(n);
    qdd_prescribed_.setZero(n);
    zero_.setZero(n);
    // An armature over several coordinates is split: its diagonal goes into the recursion, which keeps every pivot
    // positive even where only the armature has inertia; the rest follows by a low-rank correction (Woodbury).
    for (const Model::Spin& armature : model.armatures())
        for (const auto& [a, s] : armature.spin) {
            armature_diagonal_(a) += armature.inertia * s * s;
            if (armature.spin.size() > 1 && !driven_[static_cast<std::size_t>(a)] &&
                std::find(support_.begin(), support_.end(), a) == support_.end())
                support_.push_back(a);
        }
    const auto r = static_cast<Eigen::Index>(support_.size());
    coupling_.setZero(r, r);
    for (const Model::Spin& armature : model.armatures())
        for (const auto& [a, sa] : armature.spin)
            for (const auto& [b, sb] : armature.spin) {
                const auto ia = std::find(support_.begin(), support_.end(), a);
                const auto ib = std::find(support_.begin(), support_.end(), b);
                if (a != b && ia != support_.end() && ib != support_.end())
                    coupling_(ia - support_.begin(), ib - support_.begin()) += armature.inertia * sa * sb;
            }
    support_solution_.setZero(n, r);
    capacity_.setZero(r, r);
    support_qdd_.setZero(r);
    support_load_.setZero(r);
    support_correction_.setZero(r);
    capacity_lu_ = Eigen::PartialPivLU<Matrix>(r);
    offset_.setZero(n);
}

// Articulated inertias IA, joint columns U = IA S and pivots D, tip to base.
void ForwardDynamics::factorise(const Kinematics& kin) {
    Workspace& ws = kin.workspace();
    for (int k = 0; k < model_->size(); ++k)
        ws.IA[static_cast<std::size_t>(k)] = spatial_inertia(ws, model_->body(k), static_cast<std::size_t>(k));
    for (int k = model_->size() - 1; k >= 0; --k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Model::Body& body = model_->body(k);
        ws.U[i] = ws.IA[i].middleCols<3>(part(body)) * ws.e[i];
        ws.D[i] = ws.e[i].dot(ws.U[i].segment<3>(part(body))) + armature_diagonal_(k);
        if (body.parent < 0) continue;
        const std::size_t p = static_cast<std::size_t>(body.parent);
        Mat6 passed = ws.IA[i];
        if (!driven_[i]) passed -= ws.U[i] * ws.U[i].transpose() / ws.D[i];
        add_shifted(ws.IA[p], passed, ws.o[i] - ws.o[p]);
    }
}

// Bias forces tip to base, accelerations base to tip. `moving`: with velocity-product terms.
void ForwardDynamics::sweep(const Kinematics& kin, VectorIn qd, VectorIn Q, VectorIn qdd_driven, bool moving,
                            VectorOut qdd) {
    Workspace& ws = kin.workspace();
    const int n = model_->size();
    for (int k = 0; k < n; ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Model::Body& body = model_->body(k);
        ws.c[i].setZero();
        ws.pA[i].setZero();
        if (!moving) continue;
        const bool root = body.parent < 0;
        const std::size_t p = root ? 0 : static_cast<std::size_t>(body.parent);
        const Vec3 w_parent = root ? Vec3::Zero() : ws.w[p];
        const Vec3 arm = root ? Vec3::Zero() : Vec3(ws.o[i] - ws.o[p]);
        const Vec3 rate = ws.e[i] * qd(k);
        ws.w[i] = body.revolute ? Vec3(w_parent + rate) : w_parent;
        ws.c[i].tail<3>() = cross<double>(w_parent, cross<double>(w_parent, arm));
        if (body.revolute)
            ws.c[i].head<3>() = cross<double>(w_parent, rate);
        else
            ws.c[i].tail<3>() += 2 * cross<double>(w_parent, rate);
        const Vec3 c = ws.r[i] - ws.o[i];
        const Vec3 w_body = ws.E[i].transpose() * ws.w[i];
        const Vec3 F = body.inertia.mass * cross<double>(ws.w[i], cross<double>(ws.w[i], c));
        ws.pA[i].head<3>() = ws.E[i] * cross<double>(w_body, Vec3(body.J * w_body)) + cross<double>(c, F);
        ws.pA[i].tail<3>() = F;
    }
    for (int k = n - 1; k >= 0; --k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Model::Body& body = model_->body(k);
        // Inertia force of the motion that is known already: the bias acceleration c.
        ws.pA[i] += ws.IA[i] * ws.c[i];
        const double joint = ws.e[i].dot(ws.pA[i].segment<3>(part(body)));
        ws.u[i] = driven_[i] ? qdd_driven(k) : (Q(k) - joint) / ws.D[i];
        if (body.parent < 0) continue;
        const std::size_t p = static_cast<std::size_t>(body.parent);
        const Vec6 passed = ws.pA[i] + ws.U[i] * ws.u[i];
        ws.pA[p] += passed;
        ws.pA[p].head<3>() += cross<double>(ws.o[i] - ws.o[p], passed.tail<3>());
    }
    for (int k = 0; k < n; ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Model::Body& body = model_->body(k);
        Vec6 carried = Vec6::Zero();  // acceleration of the parent at this joint's origin, without c
        if (body.parent >= 0) {
            const std::size_t p = static_cast<std::size_t>(body.parent);
            carried = ws.A[p];
            carried.tail<3>() += cross<double>(ws.A[p].head<3>(), ws.o[i] - ws.o[p]);
        }
        qdd(k) = driven_[i] ? ws.u[i] : ws.u[i] - ws.U[i].dot(carried) / ws.D[i];
        ws.A[i] = carried + ws.c[i];
        ws.A[i].segment<3>(part(body)) += ws.e[i] * qdd(k);
    }
}

void ForwardDynamics::solve(const Kinematics& kin, VectorIn qd, VectorIn Q, VectorOut qdd, VectorOut actuator) {
    Workspace& ws = kin.workspace();
    qdd_prescribed_ = qdd;
    factorise(kin);

    // Armatures that couple a driven with a free coordinate load the free one with J s_a s_b qdd_b.
    offset_ = Q;
    for (const Model::Spin& armature : model_->armatures())
        for (const auto& [a, sa] : armature.spin)
            for (const auto& [b, sb] : armature.spin)
                if (!driven_[static_cast<std::size_t>(a)] && driven_[static_cast<std::size_t>(b)])
                    offset_(a) -= armature.inertia * sa * sb * qdd_prescribed_(b);
    sweep(kin, qd, offset_, qdd_prescribed_, true, qdd);

    const auto r = static_cast<Eigen::Index>(support_.size());
    if (r > 0) {  // (g0 + W X W^T) qdd = rhs:  qdd = y - Y (1 + X W^T Y)^-1 X W^T y
        for (Eigen::Index j = 0; j < r; ++j) {
            offset_.setZero();
            offset_(support_[static_cast<std::size_t>(j)]) = 1;
            sweep(kin, zero_, offset_, zero_, false, support_solution_.col(j));
        }
        for (Eigen::Index i = 0; i < r; ++i) support_qdd_(i) = qdd(support_[static_cast<std::size_t>(i)]);
        capacity_.setIdentity();
        for (Eigen::Index i = 0; i < r; ++i)
            for (Eigen::Index j = 0; j < r; ++j)
                for (Eigen::Index l = 0; l < r; ++l)
                    capacity_(i, j) += coupling_(i, l) * support_solution_(support_[static_cast<std::size_t>(l)], j);
        support_load_.noalias() = coupling_ * support_qdd_;
        capacity_lu_.compute(capacity_);
        support_correction_.noalias() = capacity_lu_.solve(support_load_);
        qdd.noalias() -= support_solution_ * support_correction_;
    }
    inverse_dynamics<double>(kin, qd, qdd, ws.bias);
    for (int k = 0; k < model_->size(); ++k)
        actuator(k) = driven_[static_cast<std::size_t>(k)] ? ws.bias(k) - Q(k) : 0.0;
}

}  // namespace cardan
