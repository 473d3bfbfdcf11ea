/// @file
/// The size of a tree.
#pragma once

#include "mbs/kernels/kinematics.hpp"

namespace cardan {

/// The largest distance of a joint or of a centre of mass from the first joint, m: what lengths are measured by where
/// nothing else is known of them.  Cost O(n)
double extent(const Kinematics& kin);

}  // namespace cardan
