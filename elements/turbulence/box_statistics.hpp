/// @file
/// Turbulence that a box holds, whatever made it, and scaling it.
#pragma once

#include "elements/turbulence/turbulence_box.hpp"
#include "mbs/base/types.hpp"

#include <cstdint>
#include <vector>

namespace cardan {

/// Statistics over all steps of a box; deviations are of the population, about the mean of each point, m/s.
struct RealisedTurbulence {
    Vec3 centre;      ///< standard deviations of u, v, w at the centre point
    Vec3 points;      ///< root of the mean variance of all points
    Mat3 covariance;  ///< of u, v, w at one point, mean over all points, m^2/s^2
};

/// Ways to scale a box so that standard deviations are those that were asked for.
enum class DeviationScaling : std::uint8_t {
    none,    ///< nothing: deviations scatter from seed to seed
    centre,  ///< each component as a whole, by its standard deviation at the centre point
    points   ///< each component at each point by its own standard deviation
};

/// Row and column of the point in the middle, of two the lower or the right one (seen along the wind).
int centre_row(const BoxGrid& grid);
int centre_column(const BoxGrid& grid);

/// Statistics of a box.
RealisedTurbulence realised(const TurbulenceBox& box);
/// Standard deviations of a component at all points, by rows, m/s.
std::vector<double> point_deviations(const TurbulenceBox& box, int component);
/// Scales a box to standard deviations of u, v, w.
/// @throws InputError for a component without turbulence where it is scaled
void scale_to(TurbulenceBox& box, const Vec3& deviations, DeviationScaling scaling);

}  // namespace cardan
