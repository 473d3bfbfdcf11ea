#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/urdf/urdf.hpp"

#include <algorithm>

namespace cardan {

namespace {

BodyId body_of(const Tree& tree, const std::string& coordinate, std::string_view where) {
    const std::vector<Tree::Body>& bodies = tree.bodies();
    const auto body =
        std::ranges::find_if(bodies, [&](const Tree::Body& b) { return b.spec.coordinate.name == coordinate; });
    if (body == bodies.end()) throw InputError(where, "coordinate", coordinate, "one of the tree");
    return BodyId{static_cast<int>(body - bodies.begin())};
}

}  // namespace

ForceSet joint_damping(const Tree& tree, const std::vector<UrdfJoint>& joints) {
    ForceSet forces;
    for (const UrdfJoint& joint : joints) {
        const std::string where = text("joint data of '", joint.coordinate, "'");
        const BodyId body = body_of(tree, joint.coordinate, where);
        require_not_negative(where, "damping", joint.damping);
        if (joint.damping > 0) forces.add_spring(joint.coordinate + " damping", body, 0, joint.damping);
    }
    return forces;
}

LoopSet mimic_couplings(const Tree& tree, const std::vector<UrdfJoint>& joints) {
    LoopSet loops;
    for (const UrdfJoint& joint : joints) {
        if (!joint.mimic) continue;
        const std::string where = text("joint data of '", joint.coordinate, "'");
        Coupling coupling{text(joint.coordinate, " mimics ", joint.mimic->joint), {}, joint.mimic->offset, "rad"};
        const BodyId own = body_of(tree, joint.coordinate, where);
        coupling.factors.emplace_back(own, 1.0);
        const BodyId other = body_of(tree, joint.mimic->joint, where);
        if (joint.mimic->multiplier != 0) coupling.factors.emplace_back(other, -joint.mimic->multiplier);
        if (entry(tree.bodies(), own.index).spec.joint == JointKind::prismatic) coupling.unit = "m";
        loops.add_coupling(std::move(coupling));
    }
    return loops;
}

}  // namespace cardan
