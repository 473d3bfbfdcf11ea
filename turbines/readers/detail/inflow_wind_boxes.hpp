/// @file
/// Boxes in InflowWind's main file. Internal to the readers: not installed.
#pragma once

#include "turbines/readers/openfast_file.hpp"
#include "turbines/readers/wind_box_file.hpp"

namespace cardan::turbines {

/// Kinds of wind in InflowWind's main file.
enum class InflowWindType : std::uint8_t { steady = 1, uniform, turbsim, bladed, hawc, user, native_bladed };

/// The box that the main file names for a kind that has one.
/// @param order  of the planes of HAWC's kind
/// @throws ParseError at the entry, also for what is wrong with the files that it names
WindBoxFile inflow_wind_box(OpenFastFile& file, InflowWindType type, PlaneOrder order);

}  // namespace cardan::turbines
