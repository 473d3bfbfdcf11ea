/// @file
/// The joints between two bodies.
#pragma once

#include "mbs/model/model.hpp"

#include <vector>

namespace cardan {

/// A coordinate that moves one body against another.
struct PathStep {
    int coordinate;
    double sign;  ///< 1: on the branch of b, -1: on that of a, which it moves the other way
};

/// Steps of the path between bodies a and b (-1: base) in order, up from a to what carries both and down to b. Turning
/// one of them carries those behind it along.
/// @param out  overwritten
void path_between(const Model& model, int a, int b, std::vector<PathStep>& out);

}  // namespace cardan
