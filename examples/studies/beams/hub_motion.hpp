/// @file
/// Prescribed motion of a frame, in its own axes, as it acts on a blade in that frame.
#pragma once

#include "mbs/base/types.hpp"

namespace cardan {

/// A prescribed coordinate with its first two derivatives with respect to time.
struct PrescribedCoordinate {
    double q = 0, qd = 0, qdd = 0;  ///< m or rad, s
};

/// Angular velocity A and velocity B of a frame in an inertial one, and the time derivatives of these COMPONENTS, all
/// in the axes of the frame, as in the 2018 paper on blades of floating turbines (docs/nrel5mw_paper2018.md). Composed
/// joint by joint from the ground: HubMotion{}.moved(...).turned(...) ...
struct HubMotion {
    Vec3 A = Vec3::Zero();        ///< angular velocity, rad/s
    Vec3 B = Vec3::Zero();        ///< velocity of the origin, m/s
    Vec3 A_dot = Vec3::Zero();    ///< dA/dt, which is the angular acceleration, rad/s^2
    Vec3 B_dot = Vec3::Zero();    ///< dB/dt; the acceleration of the origin is B_dot + A x B, m/s^2
    Vec3 gravity = Vec3::Zero();  ///< m/s^2

    /// A frame with the same axes whose origin lies at p, with rate and acceleration of these components.
    HubMotion moved(const Vec3& p, const Vec3& p_dot = Vec3::Zero(), const Vec3& p_ddot = Vec3::Zero()) const;
    /// A frame with the same origin, turned by an angle about a unit vector, right-handed.
    HubMotion turned(const Vec3& axis, const PrescribedCoordinate& angle) const;
    /// A copy with dA/dt and dB/dt left out, as in Annex A of the paper. This is not correct mechanics: since dB/dt is
    /// the derivative of the components, not even a steady velocity of the rotating frame drops out.
    HubMotion without_derivatives() const;

    /// Acceleration of a point at rest in the frame, minus gravity, is origin_acceleration() + spin_matrix() p.
    Vec3 origin_acceleration() const;
    Mat3 spin_matrix() const;  ///< [A_dot x] + [A x]^2, 1/s^2
};

}  // namespace cardan
