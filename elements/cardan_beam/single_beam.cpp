#include "elements/cardan_beam/single_beam.hpp"

#include "elements/machine_elements/joints.hpp"
#include "mbs/base/error.hpp"

namespace cardan {

Pose<double> SingleBeam::tip(VectorIn q) const {
    Workspace workspace(system.model);
    return pose(kinematics(system.model, q, workspace), beam.tip());
}

SingleBeam clamped_beam(const BeamLine& line, const CardanBeamOptions& options, const Vec3& gravity) {
    Tree tree;
    ForceSet forces;
    forces.set_gravity(gravity);
    CardanBeam beam = add_cardan_beam(tree, forces, Tree::base(), line, "beam", {"beam"}, options);
    return {std::move(beam), System(tree, forces)};
}

SingleBeam spinning_beam(const BeamLine& line, const CardanBeamOptions& options, double hub_radius) {
    require_not_negative("spinning beam", "hub radius [m]", hub_radius);
    Tree tree;
    ForceSet forces;
    const JointedFrame hub = add_joint(tree, Tree::base(), JointKind::revolute, Axis::z, "spin", {"hub"});
    const FrameId root = tree.add_frame(hub.frame, Placement::translation({hub_radius, 0, 0}), "beam root");
    CardanBeam beam = add_cardan_beam(tree, forces, root, line, "beam", {"beam"}, options);
    System system(tree, forces);
    const int spin = system.model.index(hub.body);
    return {std::move(beam), std::move(system), spin};
}

}  // namespace cardan
