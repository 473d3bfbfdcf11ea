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

#include "elements/machine/moving_base.hpp"
#include "mbs/base/units.hpp"
#include "mbs/system/channel.hpp"
#include "turbines/machines/nrel5mw_blade.hpp"

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

/// Heights, overhang, tilt (5 degrees), cone (2.5 degrees, tips upwind) are those of nrel5mw_turbine.csv. All bodies
/// except the blades are massless: the drive forces are those required by the blades.
struct Nrel5mwPlatform {
    std::shared_ptr<const System> system;
    RotorMap rotor;
    MovingBase platform;  ///< ground axes at rest
    BodyId yaw;           ///< of the nacelle about the platform's vertical axis, after the platform's rotations
    BodyId spin;          ///< azimuth: blade 1 up at zero, positive about the downwind shaft axis
    FrameId apex;         ///< rotor centre on the hub: z along the shaft (downwind), x along blade 1 without its cone
    struct Blade {
        FrameId axes;  ///< fixed to the hub at the root: x along the pitch axis (e1), z downwind (e3), y = z x x (e2)
        BodyId pitch;  ///< about e1, leading edge downwind positive
        CardanBeam beam;
    };
    std::vector<Blade> blades;
};

/// The platform's six coordinates, nacelle yaw, spin and the pitch of each blade are driven; the blades' are free.
/// @throws InputError for bad elements (see isolated_blade()), a number of blades, pitch or gravity out of range
Nrel5mwPlatform nrel5mw_on_platform(const Nrel5mwBlade& blade, const Nrel5mwPlatformOptions& options = {});

/// Channels of every blade, in its hub-fixed axes e1, e2, e3: deflection of the tip from its position on the undeformed
/// blade, m, "blade 1 tip axial deflection", "... edge ..." (e2, to the leading edge), "... flap ..." (e3, downwind);
/// and force and moment of the hub on the blade at its root, N and N m, "blade 1 root Fx" ... "blade 1 root Mz".
ChannelGroup blade_channels(const Nrel5mwPlatform& machine);

/// Channels of every driven coordinate: its position, "platform surge" ..., and the force of its drive, "platform surge
/// drive" ..., N or N m: the loads of the blades on platform, yaw bearing, shaft and pitch bearings.
ChannelGroup drive_channels(const Nrel5mwPlatform& machine);

}  // namespace cardan::turbines
