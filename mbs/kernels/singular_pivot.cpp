// Coordinates without inertia of their own, found in O(n): the pivots of the articulated-body recursion are those of
// the metric eliminated from the tips to the base.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/detail/articulated.hpp"
#include "mbs/kernels/registers/kernel_arrays.hpp"
#include "mbs/model/spatial.hpp"

namespace cardan {

namespace {

constexpr double least_pivot = 1e-12;  // over scale

// Twist of the joint at its own origin, [angular; linear].
Vec6 joint_axis(const Model::Link& link, const KernelArrays::Frame& frame) {
    Vec6 S = Vec6::Zero();
    (link.revolute ? S.head<3>() : S.tail<3>()) = frame.E[2].vector();
    return S;
}

// Largest inertia of a body in any direction, about its joint origin.
Mat6 worst_inertia(const Model::Link& link, const KernelArrays::Frame& frame) {
    const Vec3 c = (frame.r - frame.o).vector();
    Vec6 diagonal;
    diagonal.head<3>().setConstant(link.J.matrix().trace() + link.mass * c.squaredNorm());
    diagonal.tail<3>().setConstant(link.mass);
    return diagonal.asDiagonal();
}
Mat6 worst_inertia(const Model::AddedMass& water) {
    Vec6 diagonal;
    diagonal.head<3>().setConstant(water.inertia.topLeftCorner<3, 3>().trace());
    diagonal.tail<3>().setConstant(water.inertia.bottomRightCorner<3, 3>().trace());
    return diagonal.asDiagonal();
}

}  // namespace

// The recursion passes I - U U^T / D from a joint to its carrier (I: articulated inertia, U = I S, D = S . U). Rounding
// leaves errors there of the size of what was subtracted, and of the bodies' inertias about the worst axis. They are
// carried along as an inertia B of their own: where a joint yields, P = 1 - S U^T / D, an error dI becomes P^T dI P.
std::optional<SingularPivot> ForwardDynamics::singular_pivot(const Kinematics& kin) {
    const Eigen::Index n = model_->size();
    const Vector zero = Vector::Zero(n);
    Vector qdd = zero, actuator = zero;
    solve(kin, zero, zero, qdd, actuator);
    std::vector<Mat6> bound(static_cast<std::size_t>(n), Mat6::Zero());
    for (const Model::AddedMass& water : model_->added_masses()) entry(bound, water.body) = worst_inertia(water);
    for (std::size_t k = bound.size(); k-- > 0;) {
        const Model::Link& link = model_->links()[k];
        const KernelArrays::Frame& frame = kin.arrays().frame[k];
        Mat6 B = bound[k] + worst_inertia(link, frame);
        if (driven_[k] == 0) {
            const Vec6 S = joint_axis(link, frame);
            Vec6 U;
            U << articulated_[k].U_angular.vector(), articulated_[k].U_linear.vector();
            const double armature = armature_diagonal_(static_cast<Eigen::Index>(k)), own = S.dot(U);
            const double D = own + armature;
            const double scale = S.dot(B * S) + std::abs(own) + std::abs(armature);
            if (!(D > least_pivot * scale))
                return SingularPivot{most_distal(kin, static_cast<int>(k), scale), D, scale};
            const Mat6 P = Mat6::Identity() - S * U.transpose() / D;
            B = (P.transpose() * B * P + U * U.transpose() / D).eval();
        }
        if (link.parent < 0) continue;
        const Mat6 X = twist_shift<double>((frame.o - entry(kin.arrays().frame, link.parent).o).vector());
        entry(bound, link.parent) += X.transpose() * B * X;
    }
    return singular_pivot_of_support();
}

// The motion without inertia: coordinate `at` moves and the joints it carries yield. If a joint further out cancels it
// (two joints that do the same thing), that one is named.
int ForwardDynamics::most_distal(const Kinematics& kin, int at, double scale) const {
    std::vector<Vec6> twist(static_cast<std::size_t>(model_->body(at).subtree_end - at));
    int named = at;
    for (int k = at; k < model_->body(at).subtree_end; ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const Model::Link& link = model_->links()[i];
        const KernelArrays::Frame& frame = kin.arrays().frame[i];
        Vec6& own = entry(twist, k - at);
        if (k == at) {
            own = joint_axis(link, frame);
            continue;
        }
        const Vec3 arm = (frame.o - entry(kin.arrays().frame, link.parent).o).vector();
        own = twist_shift<double>(arm) * entry(twist, link.parent - at);
        if (driven_[i] != 0) continue;
        Vec6 U;
        U << articulated_[i].U_angular.vector(), articulated_[i].U_linear.vector();
        const double rate = -U.dot(own) * articulated_[i].yield;
        own += rate * joint_axis(link, frame);
        if (rate * rate > 1e-6 * scale * articulated_[i].yield) named = k;
    }
    return named;
}

// With armatures over several coordinates the recursion works on g_0 = g - W X W^T. The metric of their coordinates
// alone, all others being free, is (W^T g_0^-1 W)^-1 + X.
std::optional<SingularPivot> ForwardDynamics::singular_pivot_of_support() const {
    if (support_.empty()) return std::nullopt;
    const Eigen::Index r = support_inverse_.rows();
    const Matrix without = support_inverse_.llt().solve(Matrix::Identity(r, r));
    const Vector scale = without.diagonal() + coupling_.diagonal().cwiseAbs();
    auto pivot = cardan::singular_pivot(without + coupling_, scale);
    if (pivot) pivot->index = entry(support_, pivot->index);
    return pivot;
}

// A massless leaf is legal if it is driven or carries an armature, and a body with mass can still be singular, so it is
// the metric of the unknowns that is looked at.
void Model::check_metric() const {
    Workspace workspace(*this);
    ForwardDynamics dynamics(*this);
    const auto pivot = dynamics.singular_pivot(kinematics(*this, Vector::Zero(size()), workspace));
    if (!pivot) return;
    const int at = pivot->index;
    const bool negative = pivot->value < -1e-12 * pivot->scale;
    throw InputError(text(negative ? "indefinite" : "singular", " metric: coordinate '", coordinates_[at].name,
                          "' of body '", body(at).name, "' has ", negative ? "negative" : "no",
                          " inertia of its own (pivot ", pivot->value, ", scale ", pivot->scale,
                          "; allowed: pivot > 1e-12 scale). ",
                          negative ? "A negative armature is larger than the inertia that it takes from"
                                   : "Give the bodies that it carries mass or inertia about its axis, add an "
                                     "armature, or drive it"));
}

}  // namespace cardan
