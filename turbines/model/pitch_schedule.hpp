/// @file
/// Angles by which the blades of a machine may turn out of feather.
#pragma once

#include <vector>

namespace cardan::turbines {

/// Minimum pitch at a wind speed.
struct PitchAtWind {
    double wind = 0;   ///< m/s
    double pitch = 0;  ///< rad, positive toward feather
};

/// Linear between the winds of a schedule, constant beyond its ends, rad.
/// @throws InputError for a schedule that is empty or does not ascend
double pitch_at(const std::vector<PitchAtWind>& schedule, double wind);

}  // namespace cardan::turbines
