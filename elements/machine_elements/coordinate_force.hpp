/// @file
/// A force on one coordinate that depends on its position, its rate and the time.
#pragma once

#include "mbs/system/forces.hpp"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace cardan {

/// Coordinates with factors whose weighted sum is an angle (of a hub behind several shafts, a mean pitch).
using CoordinateSum = std::vector<std::pair<BodyId, double>>;

/// Force along a coordinate (N m or N, positive along it) with its derivatives and the energy stored, J.
struct CoordinateLaw {
    double force = 0, by_position = 0, by_rate = 0, energy = 0;
};

/// The law as a force element with exact Jacobian. Allocates nothing unless `law` does.
/// @param elastic  a spring: it has an energy, and -dQ/dq counts as elastic stiffness
ForceElement coordinate_force(std::string name, BodyId coordinate,
                              std::function<CoordinateLaw(double time, double position, double rate)> law,
                              bool elastic);

}  // namespace cardan
