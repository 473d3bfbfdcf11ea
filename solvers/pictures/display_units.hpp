/// @file
/// Display units of pictures and printouts. Internally and in files everything is SI.
#pragma once

#include "mbs/system/channel.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace cardan::solvers {

/// Units in which angles are shown.
enum class AngleUnits : std::uint8_t {
    degrees,  ///< rad as deg; rad/s as rpm for channels whose name ends in "speed", as deg/s otherwise; rad/s^2 as
              ///< deg/s^2
    radians,  ///< as recorded
};

/// shown value = factor * value of the channel
struct ShownUnits {
    double factor = 1;
    std::string units;  ///< in the notation of the channels, e.g. "deg s-1"
};

ShownUnits shown_units(const Channel& channel, AngleUnits angles);

/// Adds a decimal prefix for numbers of about this size: kN m, MW, mm. Units that take prefixes are N, N m, W, J, Pa
/// and, for small values only, m and s. From 0.01 to 1000 there is no prefix.
/// @param largest  absolute value in these units; 0 or not finite: no prefix
ShownUnits with_prefix(std::string_view units, double largest);

/// A unit in ordinary notation: "m s-2" is "m/s²", "N m rad-1" is "N m/rad", "kg m2" is "kg m²"; a pure number ("1",
/// "-") is "–". What is not in the notation of the channels stays as it is.
std::string display_text(std::string_view units);

/// Units of a power spectral density of a channel, in ordinary notation: "m²/Hz", "(N m)²/Hz".
std::string density_text(std::string_view units);

}  // namespace cardan::solvers
