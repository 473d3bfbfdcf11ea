/// @file
/// Denavit-Hartenberg parameters of a tree (Khalil and Kleinfinger 1986).
#pragma once

#include "mbs/model/spatial.hpp"

#include <cstdint>

namespace cardan {

/// One joint, one coordinate: rotation about or translation along the joint axis z of the outboard frame.
enum class JointKind : std::uint8_t { revolute, prismatic };

/// Six parameters from a body's frame i to the frame j of a joint that it carries, z_j being the joint axis:
///
///     T_ij = Rz(gamma) Tz(b)  Rx(alpha) Tx(d)  Rz(theta) Tz(r)
///
///         z_i            z_j
///          |  gamma, b    \   theta, r            theta = theta0 + q   revolute joint
///          |               \                      r     = r0 + q       prismatic joint
///          o----- d, alpha --o
///           common normal x
///
/// The first pair turns x_i onto the common normal of z_i and z_j and is needed only for the second and further
/// children of a body and for children of the base; gamma = b = 0 is the classical (modified) convention. The six
/// parameters represent every pose.
struct DhParameters {
    double gamma = 0;   ///< about z_i, rad
    double b = 0;       ///< along z_i, m
    double alpha = 0;   ///< about the common normal, rad
    double d = 0;       ///< along the common normal, m
    double theta0 = 0;  ///< about z_j, rad
    double r0 = 0;      ///< along z_j, m

    Placement placement() const;
};

/// The parameters of a given pose; alpha lies in [0, pi]. For nearly parallel axes b and r0 become very large (1 / sin
/// alpha); below sin alpha = 1e-8 the axes are treated as parallel. The pose is reproduced to 1e-8 throughout. For this
/// reason poses are stored as placements, and these parameters serve for input and output only.
DhParameters dh_parameters(const Placement& placement);

}  // namespace cardan
