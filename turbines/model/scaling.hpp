/// @file
/// A machine of another size by similarity rules: same materials, same shape, same tip speed.
#pragma once

#include "turbines/model/description.hpp"

namespace cardan::turbines {

/// The machine with all lengths multiplied by s. Speeds and stresses under aerodynamic loads stay the same, so that
///
///     length, time                          s      mass                                s^3
///     mass per length, EA, GA               s^2    inertia per length                  s^4
///     EI, GJ                                s^4    moment of inertia                   s^5
///     spring, damper of a rotation          s^3, s^4    of a translation               s, s^2
///     rotor speed, natural frequencies      1/s    power, thrust                       s^2
///     stiffness, damping, added mass of a platform s, s^2, s^3, and s for each of the two coordinates that is an angle
///     buoyancy, pull of mooring lines       s^2 (gravity times 1/s would balance it)
///     angles, twist, damping ratios, gear ratio    unchanged
///
/// By dimensional analysis the ratios of frequencies to rotor speed stay exactly the same as long as gravity is
/// neglected: it does not scale, and stresses due to self-weight grow with s. From 5 MW to 15 MW: s = sqrt(3).
/// @throws InputError unless s is finite and positive
TurbineDescription scaled(const TurbineDescription& description, double s);

/// A beam scaled by s.
BeamLine scaled(const BeamLine& line, double s);

}  // namespace cardan::turbines
