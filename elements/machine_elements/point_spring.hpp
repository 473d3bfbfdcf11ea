/// @file
/// Springs, dampers and cables between two points.
#pragma once

#include "mbs/system/forces.hpp"

namespace cardan {

/// Pulls the origins of two frames together with
///
///     T = stiffness (L - length) + damping dL/dt
///
/// along the line between them, L their distance. Where they meet the line has no direction; that of the x axis is
/// taken.
struct PointSpring {
    std::string name = {};
    FrameId a = {}, b = {};
    double stiffness = 0;  ///< N/m, >= 0
    double damping = 0;    ///< N s/m, >= 0
    double length = 0;     ///< without tension, m, >= 0
    /// A cable: slack below its length, without any force, and never pushing. At its length the force of the damper
    /// jumps; without damping the force is continuous.
    bool cable = false;
};

/// Adds a spring with exact derivatives and energy; loads of joints and channels take it into account. Its stiffness
/// counts as elastic.
/// @throws InputError for values out of range, and a spring without stiffness and damping
void add_point_spring(ForceSet& forces, const PointSpring& spring);

}  // namespace cardan
