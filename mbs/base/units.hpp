/// @file
/// Units of angles, speeds and times, and the standard acceleration of free fall.
#pragma once

#include "mbs/base/types.hpp"

/// Everything computes in SI units and radians. Multiply an angle or speed given in other units by its unit, `5 *
/// units::degree`; to display one, multiply by units::to_degrees or units::to_rpm.
namespace cardan::units {

inline constexpr double degree = pi / 180;      ///< rad
inline constexpr double rpm = pi / 30;          ///< one revolution per minute, rad/s
inline constexpr double minute = 60;            ///< s; a speed in rev/min over it is a frequency in Hz
inline constexpr double to_degrees = 180 / pi;  ///< deg / rad
inline constexpr double to_rpm = 30 / pi;       ///< rev/min / (rad/s)

/// Standard acceleration of free fall, m/s^2 (3rd General Conference on Weights and Measures, 1901).
inline constexpr double standard_gravity = 9.80665;

}  // namespace cardan::units
