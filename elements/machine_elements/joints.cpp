#include "elements/machine_elements/joints.hpp"

namespace cardan {

Mat3 axis_rotation(Axis axis) {
    switch (axis) {
        case Axis::x:
            return (Mat3() << Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()).finished();
        case Axis::y:
            return (Mat3() << Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()).finished();
        case Axis::z:
            break;
    }
    return Mat3::Identity();
}

JointedFrame add_joint(Tree& tree, FrameId carrier, JointKind kind, Axis axis, const std::string& name,
                       const PartLabel& label, const Vec3& offset, CoordinateRole role) {
    const Mat3 R = axis_rotation(axis);
    BodySpec spec;
    spec.name = name;
    spec.inboard = carrier;
    spec.placement = {R, offset};
    spec.joint = kind;
    spec.coordinate.part = label.part;
    spec.coordinate.blade = label.blade;
    spec.coordinate.role = role;
    const BodyId body = tree.add_body(spec);
    return {body, tree.add_frame(tree.frame_of(body), Placement::rotation(R.transpose()), name + " axes")};
}

JointedFrame add_joint(Tree& tree, FrameId carrier, JointKind kind, Axis axis, const std::string& name,
                       const PartLabel& label, CoordinateRole role) {
    return add_joint(tree, carrier, kind, axis, name, label, Vec3::Zero(), role);
}

}  // namespace cardan
