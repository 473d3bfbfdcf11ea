/// @file
/// The static-moment partition: each hinge mode has the linear momentum of the exact static deflection.
#pragma once

#include "elements/cardan_beam/partition.hpp"

namespace cardan {

/// Takes a segment partition with hinges at delta L and (1 - delta) L, moves its bodies along the axis and replaces
/// their tensors by slender ones; mass, first and second moment along the axis are kept.
/// @throws InputError: a segment without mass; a negative moment of inertia left for the middle bodies
void move_to_static_moment(const ElementLine& on, double delta, ElementInertia& element);

}  // namespace cardan
