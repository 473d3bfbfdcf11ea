/// @file
/// Axes in which channels are given. Internal to channels: not installed.
#pragma once

#include "mbs/model/spatial.hpp"

namespace cardan::turbines {

/// x downwind, y toward the trailing edge, z to the tip, from blade axes (x to the tip, y leading edge, z downwind).
inline Mat3 openfast_axes(const Mat3& blade) {
    return (Mat3() << blade.col(2), -blade.col(1), blade.col(0)).finished();
}

/// x downwind, y to the left, z up, from axes of the tower's beam (x up, y downwind).
inline Mat3 foot_axes(const Mat3& beam) {
    return (Mat3() << beam.col(1), beam.col(2), beam.col(0)).finished();
}

/// Writes three values and goes on to the next.
inline void write(const Vec3& v, double*& values) {
    for (double component : v) *values++ = component;
}

}  // namespace cardan::turbines
