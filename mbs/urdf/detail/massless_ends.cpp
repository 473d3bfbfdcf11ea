#include "mbs/urdf/detail/massless_ends.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cardan::urdf_impl {

namespace {

struct Leader {
    int body;
    double factor;
};

// The independent joint at the end of the mimics that begin at a body; none if the body's joint mimics none, or the
// mimics run in a circle or to no coordinate.
std::optional<Leader> leader(const UrdfModel& robot, int body) {
    Leader at{body, 1};
    for (std::size_t steps = 0; steps <= robot.joints.size(); ++steps) {
        const UrdfJoint& joint = entry(robot.joints, at.body);
        if (!joint.mimic) return at.body == body ? std::nullopt : std::optional(at);
        const auto next = std::ranges::find(robot.joints, joint.mimic->joint, &UrdfJoint::coordinate);
        if (next == robot.joints.end()) return {};
        at = {static_cast<int>(next - robot.joints.begin()), at.factor * joint.mimic->multiplier};
    }
    return {};
}

// Mass, or moment of inertia about the joint's axis, of a body and what is welded to it.
double own_inertia(const Tree& tree, int body) {
    double sum = 0;
    for (const Tree::Piece& piece : tree.pieces()) {
        if (piece.body != body) continue;
        const RigidInertia& part = piece.inertia;
        sum += entry(tree.bodies(), body).spec.joint == JointKind::prismatic
                   ? part.mass
                   : part.J(2, 2) + part.mass * part.com.head<2>().squaredNorm();
    }
    return sum;
}

}  // namespace

std::vector<bool> carries_inertia(const Tree& tree) {
    std::vector<bool> carries(tree.bodies().size(), false);
    for (const Tree::Piece& piece : tree.pieces())
        if (piece.body >= 0 && !piece.inertia.is_massless()) entry(carries, piece.body) = true;
    for (std::size_t k = carries.size(); k-- > 0;)
        if (const int parent = tree.bodies()[k].parent; carries[k] && parent >= 0) entry(carries, parent) = true;
    return carries;
}

std::string couple_massless_end(UrdfModel& robot, int body) {
    constexpr double share = 1e-6;
    const std::optional<Leader> by = leader(robot, body);
    if (!by) return {};
    const double available = own_inertia(robot.tree, by->body);
    if (!(available > 0)) return {};
    const double square = by->factor * by->factor, armature = square > 0 ? share * available / square : available;
    if (!std::isfinite(armature)) return {};
    const std::string& follower = entry(robot.joints, body).coordinate;
    const std::string& other = entry(robot.joints, by->body).coordinate;
    robot.tree.add_armature({follower + " armature", armature, {{BodyId{body}, 1.0}}});
    if (square > 0)
        robot.tree.add_armature(
            {text(follower, " armature taken from ", other), -share * available, {{BodyId{by->body}, 1.0}}});
    return text(
        "'", follower, "' moves no inertia and mimics '", other, "': an armature of ", armature,
        " keeps its equation regular",
        square > 0 ? text(" and one of ", -share * available, " on '", other, "' takes it back") : std::string(),
        "; with mimic_couplings() both cancel");
}

}  // namespace cardan::urdf_impl
