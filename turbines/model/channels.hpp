/// @file
/// What is recorded of a turbine in motion: speeds, deflections, loads.
///
/// Channels that OpenFAST has, too, bear its name as an alias and mean the same in the same axes and signs; their units
/// are SI (rad, rad/s, N, N m), where OpenFAST has degrees, rpm, kN and kN m. Loads are those that the part outboard of
/// (above) the cut exerts on the part inboard of (below) it. Axes:
///   tower base (t): x downwind, y to the left for who looks downwind, z up, fixed to the foot;
///   tower top (p): the same, carried by the top of the tower, below the yaw bearing;
///   blade k coned (c): x along the shaft (downwind, cone apart), y toward the trailing edge at zero pitch, z along the
///   pitch axis to the tip, carried by the hub;
///   blade k (b): the same turned by the pitch, carried by the root of the blade.
/// PtfmSurge ... PtfmYaw are the displacement of the platform's reference point in ground axes and the angles of
/// R_z(yaw) R_y(pitch) R_x(roll); OpenFAST's are the same while they are small.
/// On a platform that moves the displacements of the tower top are relative to the foot, its accelerations absolute.
#pragma once

#include "mbs/system/channel.hpp"
#include "turbines/model/assembly.hpp"

namespace cardan::turbines {

/// A user force as the wrench it is: force (N) and moment (N m) at a frame's origin, base axes. Loads by equilibrium
/// cannot know what a user force does to them unless they are told so.
struct ExternalWrench {
    FrameId frame = {};
    std::function<Wrench(const ForceInput&)> wrench = {};
};

/// Channels of rotor, tower and blades as far as the machine has them. Loads are found by equilibrium of what lies
/// outboard: inertial forces, gravity, wrenches of the force set and `external`; user forces that are not listed there
/// are left out, but for those inside of joints (generator, brake, drives), which make no difference.
/// @throws InputError for an external wrench without a function or on the base
std::vector<ChannelGroup> channels(const Turbine& turbine, std::vector<ExternalWrench> external = {});

}  // namespace cardan::turbines
