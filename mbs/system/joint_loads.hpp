/// @file
/// Loads that the joints transmit while the tree moves.
#pragma once

#include "mbs/kernels/dynamics.hpp"
#include "mbs/loops/loops.hpp"
#include "mbs/system/forces.hpp"

#include <span>
#include <vector>

namespace cardan {

/// Motion of a body, base axes.
struct BodyMotion {
    Vec3 origin;        ///< of its joint frame, m
    Vec3 acceleration;  ///< of the origin, m/s^2
    Vec3 angular_velocity, angular_acceleration;
    /// Acceleration of the body's point at r (base axes), m/s^2.
    Vec3 at(const Vec3& r) const {
        const Vec3 arm = r - origin;
        return acceleration + cross<double>(angular_acceleration, arm) +
               cross<double>(angular_velocity, cross<double>(angular_velocity, arm));
    }
};

/// Motion and joint loads of all bodies at one state.
struct JointLoads {
    double time = 0;                 ///< s: wrenches are those of this time
    std::vector<BodyMotion> motion;  ///< one per body
    /// Force and moment about the joint origin that the joint (drive, spring and bearing together) exerts on its body:
    /// inertial forces of the subtree minus gravity, wrenches, elements with points and loops on it, base axes. Forces
    /// of elements on coordinates are left out, since they are not given as wrenches; armatures have no reaction.
    std::vector<Wrench> joint;
    std::vector<std::vector<Wrench>> elements;  ///< BoundElements::wrenches() of each; of one without points: none
    std::vector<LoopLoad> loops = {};           ///< Loops::add_loads()
};

/// Calls visit(point, wrench) for all points of all elements.
template <class Visit>
void for_each_point(const Forces& forces, const JointLoads& loads, const Visit& visit) {
    for (std::size_t e = 0; e < loads.elements.size(); ++e)
        for (std::size_t i = 0; i < loads.elements[e].size(); ++i)
            visit(forces.elements()[static_cast<int>(e)].points[i], loads.elements[e][i]);
}

/// @param qdd    accelerations, size n
/// @param loops  what loops exert, Loops::add_loads()
JointLoads joint_loads(const StateView& at, const Forces& forces, VectorIn qdd, std::vector<LoopLoad> loops = {});

}  // namespace cardan
