#include "mbs/base/error.hpp"
#include "mbs/urdf/urdf.hpp"

#include <algorithm>

namespace cardan {

ForceSet joint_damping(const Tree& tree, const std::vector<UrdfJoint>& joints) {
    ForceSet forces;
    const std::vector<Tree::Body>& bodies = tree.bodies();
    for (const UrdfJoint& joint : joints) {
        const auto body = std::find_if(bodies.begin(), bodies.end(),
                                       [&](const Tree::Body& b) { return b.spec.coordinate.name == joint.coordinate; });
        const std::string where = text("joint data of '", joint.coordinate, "'");
        if (body == bodies.end()) throw InputError(where, "coordinate", joint.coordinate, "one of the tree");
        require_not_negative(where, "damping", joint.damping);
        if (joint.damping > 0)
            forces.add_spring(joint.coordinate + " damping", BodyId{static_cast<int>(body - bodies.begin())}, 0,
                              joint.damping);
    }
    return forces;
}

}  // namespace cardan
