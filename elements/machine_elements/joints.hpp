/// @file
/// Joints along the axes of a frame; several of them make cardan, cylindrical and planar joints.
#pragma once

#include "mbs/base/text.hpp"
#include "mbs/model/tree.hpp"

namespace cardan {

enum class Axis : std::uint8_t { x, y, z };

/// Label of the part that a coordinate belongs to.
struct PartLabel {
    std::string part = {};
    int blade = 0;
    /// "blade 2", "tower".
    std::string name() const { return blade > 0 ? part + " " + text(blade) : part; }
};

/// A body on a joint, and the frame on it whose axes coincide with the carrier's at q = 0.
struct JointedFrame {
    BodyId body;
    FrameId frame;
};

/// A massless body on a joint about (revolute) or along (prismatic) an axis of `carrier`, at `offset` in it.
/// Its coordinate has the body's name; the frame is called "<name> axes".
JointedFrame add_joint(Tree& tree, FrameId carrier, JointKind kind, Axis axis, const std::string& name,
                       const PartLabel& label, const Vec3& offset = Vec3::Zero(),
                       CoordinateRole role = CoordinateRole::free);
/// Adds a joint at the origin of its carrier. (In place of the offset `{}` would be a vector without values.)
JointedFrame add_joint(Tree& tree, FrameId carrier, JointKind kind, Axis axis, const std::string& name,
                       const PartLabel& label, CoordinateRole role);

/// Rotation that takes the z axis onto the given axis (cyclic permutation of the axes).
Mat3 axis_rotation(Axis axis);

}  // namespace cardan
