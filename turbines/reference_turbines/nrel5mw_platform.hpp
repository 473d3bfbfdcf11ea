/// @file
/// Blades of the NREL 5 MW machine on a moving platform: tower, nacelle, shaft and hub rigid, all their motions driven.
///
/// Frames. Ground axes of the library: x downwind, z up. The axes of the reference solution
/// (docs/nrel5mw_platform.md) are X0 = z (up), Z0 = x (downwind), Y0 = Z0 x X0 = -y. The platform's coordinates:
///
///     surge  along Z0   sway   along Y0   heave  along X0
///     roll   about Z0   pitch  about Y0   yaw    about X0      turned in the order roll, pitch, yaw
///
/// A positive pitch th moves the top of the tower UPWIND: I1 = cos th X0 - sin th Z0. OpenFAST's platform pitch and
/// sway have opposite signs, its surge, heave, roll and yaw the same signs.
#pragma once

#include "mbs/base/units.hpp"
#include "mbs/system/channel.hpp"
#include "turbines/reference_turbines/nrel5mw_blade.hpp"

namespace cardan::turbines {

/// Stiffness-proportional damping coefficient, s: damping ratio 0.477465 % at the first flap frequency of the blade.
inline constexpr double nrel5mw_platform_damping = 2.244135e-3;

/// Beam elements as in nrel5mw_blade_elements(), with damping D = beta K.
CardanBeamOptions nrel5mw_platform_elements(int elements = 16, double beta = nrel5mw_platform_damping);
/// The blade of the reference solution: as tabulated, with GA = 20 EA.
Nrel5mwBlade nrel5mw_platform_blade();

struct Nrel5mwPlatformOptions {
    int blades = 1;  ///< 1 ... 3; blade k stands 120 degrees ahead of blade k - 1
    CardanBeamOptions elements = nrel5mw_platform_elements();
    double pitch = 0;                              ///< setting of all blades, leading edge upwind positive, rad
    Vec3 gravity{0, 0, -units::standard_gravity};  ///< ground axes, m/s^2
};

/// The machine as described below.
/// @throws InputError for a number of blades out of range
TurbineDescription nrel5mw_platform_description(const Nrel5mwBlade& blade, const Nrel5mwPlatformOptions& options = {});

/// Heights, overhang, tilt (5 degrees), cone (2.5 degrees, tips upwind) are those of nrel5mw_turbine.csv. All bodies
/// except the blades are massless: the drive forces are those required by the blades. The platform's six coordinates,
/// the yaw of the nacelle, the rotor and the pitch of each blade are driven; the blades' are free.
/// @throws InputError for bad elements (see isolated_blade()), a number of blades, pitch or gravity out of range
Turbine nrel5mw_on_platform(const Nrel5mwBlade& blade, const Nrel5mwPlatformOptions& options = {});

/// Channels of every blade with a pitch joint, in its hub-fixed axes (MachineLayout::pitch_axes) e1 along the pitch
/// axis, e2 to the leading edge, e3 downwind: deflection of the tip from its position on the undeformed blade, m,
/// "blade 1 tip axial deflection", "... edge ..." (e2), "... flap ..." (e3); and force and moment of the hub on the
/// blade at its root, N and N m, "blade 1 root Fx" ... "blade 1 root Mz".
ChannelGroup blade_channels(const Turbine& machine);

}  // namespace cardan::turbines
