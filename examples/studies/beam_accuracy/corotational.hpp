/// @file
/// Large plane deflections by cubic elements that turn with their chord.
#pragma once

#include "elements/sections/beam_line.hpp"

namespace cardan::accuracy {

/// Tip of a clamped uniform inextensible beam bent in the plane x-z by a dead tip force and moment (about y), beam
/// axes. Three unknowns per element. In the frame of the chord an element is a Hermite beam; the stretch of its axis
/// counts the bow, (l - L)/L + (2 a^2 - a b + 2 b^2)/30 with the end rotations a, b, averaged over the element.
/// [Crisfield, Non-linear Finite Element Analysis of Solids and Structures 1 (1991), chapter 7]
/// @throws NumericalError if Newton's method does not converge
Vec3 corotational_tip(const BeamLine& line, int elements, const Vec3& force, const Vec3& moment);

}  // namespace cardan::accuracy
