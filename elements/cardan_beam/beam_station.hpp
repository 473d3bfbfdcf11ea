/// @file
/// A place on a beam that is looked at again and again: pose, acceleration and loads of its section.
#pragma once

#include "elements/cardan_beam/section_loads.hpp"

namespace cardan {

/// A station on a beam. What does not depend on the state (which rigid segment, the masses on either side of it) is
/// found once, so that a state costs O(number of wrenches) and no allocation. It stays valid without the beam, for
/// every model of the beam's tree.
///
/// Between two hinges the beam is rigid, so pose and acceleration are those of the rigid segment there. Nodes are as
/// accurate as the element (O(h^4) with Gauss hinges); elsewhere displacements are off by up to 0.022 kappa h^2 and
/// rotations by up to 0.29 kappa h, with the element's length h and the curvature kappa. Put a node there
/// (CardanBeamOptions::boundaries) where that matters. Loads, by equilibrium, do not suffer from it.
class BeamStation {
public:
    /// @param s  arc length along the reference line, m, 0 ... length of the beam. At a node: just inboard of it,
    ///           whatever is fixed to the node counts as outboard; at the root: just outboard of node 0
    ///
    /// @throws InputError if s lies outside the beam
    BeamStation(const CardanBeam& beam, double s);

    /// Axes of the section (x tangent; y and z those of the line, not of the principal axes), origin on the reference
    /// line; base axes.
    Pose<double> pose(const Kinematics& kin) const;
    /// Acceleration of the point of the reference line, base axes, m/s^2; relative to the ground, without gravity.
    Vec3 acceleration(const Kinematics& kin, const JointLoads& loads) const;
    /// Force and moment about the point of the reference line that the outboard part exerts on the inboard part, base
    /// axes, by equilibrium: see equilibrium_loads().
    Wrench load(const Kinematics& kin, const Forces& forces, const JointLoads& loads) const;

private:
    Placement element_axes(const Kinematics& kin) const;
    BodyMotion motion(const Kinematics& kin, const JointLoads& loads) const;
    bool holds(FrameId frame, const Model& model) const;
    bool is_before(const Vec3& place, const Kinematics& kin) const;
    Vec6 inertia_less_weight(const Placement& axes, const BodyMotion& motion, const Vec3& gravity) const;

    FrameId carrier_;      ///< on the rigid segment, element axes
    double x_of_carrier_;  ///< its place along the chord
    Placement section_;    ///< in element axes
    double x_, tolerance_;
    std::vector<FrameId> nodes_;
    BodyId joint_;          ///< the hinge from which the section is reached
    bool inward_;           ///< that hinge lies outboard of it
    double share_;          ///< of the segment: between section and hinge
    RigidInertia whole_;    ///< the segment, element axes
    Eigen::Matrix4d rest_;  ///< int [x; 1] [x; 1]^T dm, element axes: true masses between section and hinge less that
                            ///< share of the segment's
};

}  // namespace cardan
