/// @file
/// Channels recorded from a turbine in motion: speeds, deflections, loads.
///
/// Channels that also exist in OpenFAST have its name as an alias, with the same meaning, axes and signs; their units
/// are SI (rad, rad/s, N, N m), where OpenFAST has degrees, rpm, kN and kN m. Loads are those that the part outboard of
/// (above) the cut exerts on the part inboard of (below) it. Axes:
///   tower base (t): x downwind, y to the left when looking downwind, z up, fixed to the foot; tower top (p): the same,
///   fixed to the top of the tower, below the yaw bearing; blade k coned (c): x along the shaft (downwind, cone apart),
///   y toward the trailing edge at zero pitch, z along the pitch axis to the tip, carried by the hub; blade k (b): the
///   same turned by the pitch, carried by the root of the blade.
/// PtfmSurge ... PtfmYaw are the displacement of the platform's reference point in ground axes and the angles of
/// R_z(yaw) R_y(pitch) R_x(roll); OpenFAST's are the same for small angles. On a moving platform displacements of the
/// tower top are relative to the foot, its accelerations absolute.
#pragma once

#include "mbs/system/channel.hpp"
#include "turbines/model/assembly.hpp"

namespace cardan::turbines {

/// Channels of those of rotor, tower (also one that is rigid) and blades that the machine has. Loads follow from
/// equilibrium of everything outboard: inertial forces, gravity, wrenches and elements with points. Forces of
/// elements on coordinates are ignored, which makes no difference for those inside joints (generator, brake, drives).
/// Sections between the ends of blades and tower: station_channels().
std::vector<ChannelGroup> channels(const Turbine& turbine);

/// Channels of every driven coordinate: its position, "platform surge" ..., and the force of its drive, "platform surge
/// drive" ..., N or N m.
ChannelGroup drive_channels(const Turbine& turbine);

}  // namespace cardan::turbines
