/// @file
/// Trees put together from other trees; momentum.
#pragma once

#include "mbs/kernels/kinematics.hpp"

namespace cardan::testing {

/// The rotation by the smallest angle that carries the direction `from` onto that of `to`.
Mat3 shortest_turn(const Vec3& from, const Vec3& to);

/// The shortest turn that carries z onto `axis`.
Mat3 axis_frame(const Vec3& axis);

/// A massless body on a joint along or about `axis` of `inboard`; its own frame has z along the axis.
BodySpec joint_spec(std::string name, FrameId inboard, JointKind kind, const Vec3& axis);

/// A joint at the origin of `inboard`; axis and inertia are given in the axes of `inboard`.
struct Joint {
    std::string name;
    FrameId inboard = {};
    JointKind kind = JointKind::revolute;
    Vec3 axis = Vec3::UnitZ();
    RigidInertia inertia = {};
    CoordinateRole role = CoordinateRole::free;
};
/// The body behind a joint and its frame "<name> axes", which lies like that of `inboard` at q = 0: so a chain is
/// written down in one set of axes.
struct Link {
    BodyId body;
    FrameId axes;
};
Link add_joint(Tree& tree, const Joint& joint);

/// A body that slides along x and y of the base, without turning.
struct PlaneMass {
    Link x, y;
};
PlaneMass add_plane_mass(Tree& tree, double mass);

/// Adds the bodies and armatures of `source` to `target`; what stood on the base stands on `onto`.
/// @param order  body indices of `source`, parents before children; empty: as they are
/// @return the new bodies, by index in `source`
std::vector<BodyId> transplant(Tree& target, FrameId onto, const Tree& source, std::vector<int> order = {});

/// Three translations x, y, z and three rotations about x, y, z, all massless; the frame of the last one.
FrameId add_floating_base(Tree& tree);

/// Linear and angular momentum about the base origin, base axes, from the basis functions u and Omega. Armatures have
/// no part in them.
struct Momentum {
    Vec3 linear = Vec3::Zero();   ///< kg m/s
    Vec3 angular = Vec3::Zero();  ///< kg m^2/s
    Vec3 centre = Vec3::Zero();   ///< centre of mass, m
};
Momentum momentum(const Kinematics& kin, VectorIn qd);

}  // namespace cardan::testing
