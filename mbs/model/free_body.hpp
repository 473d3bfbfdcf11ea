/// @file
/// Pose and velocities of bodies that nothing holds (Tree::add_free_body()), whatever their coordinates are.
#pragma once

#include "mbs/model/model.hpp"

namespace cardan {

/// A free body as seen from its inboard frame, in the axes of that.
struct FreeMotion {
    Placement pose = {};    ///< of the body's frame
    Vec3 v = Vec3::Zero();  ///< of its origin, m/s
    Vec3 w = Vec3::Zero();  ///< angular velocity, rad/s
};

/// @param q, qd  size n
FreeMotion free_motion(const Model::Free& body, const Vector& q, const Vector& qd);

/// Writes the coordinates and rates of a free body for a pose and velocities; of all coordinates that give them those
/// that are farthest from a singularity.
/// @param q, qd  in and out, size n
/// @throws InputError for a pose that is not one, or values that are not finite
void set_free_motion(const Model::Free& body, const FreeMotion& motion, Vector& q, Vector& qd);

/// Distance of its coordinates from being singular: 1 as set_free_motion() leaves them, 0 where they are.
double free_chart_quality(const Model::Free& body, const Vector& q);

}  // namespace cardan
