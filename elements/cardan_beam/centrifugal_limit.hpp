/// @file
/// The rotor speed above which a beam of cardanic elements loses its stiffness.
#pragma once

#include "elements/cardan_beam/cardan_beam.hpp"

namespace cardan {

/// Smallest spin speed, rad/s, at which the centrifugal force cancels the stiffness of a hinge of the beam; infinity if
/// there is none.
///
/// With Partition::mean_difference on an element whose stiffness falls off, the last body's centre of mass lies inboard
/// of its hinge: the centrifugal force deflects it further instead of straightening it. This is a property of the
/// discretisation, not of the beam. The limit rises with the number of elements; do not trust frequencies at speeds
/// above half the limit. True segments have no limit.
///
/// Estimated for each hinge by itself, in its softest direction, in or out of the plane of rotation, with the masses at
/// the radius root_radius + x: from 2 % below to 5 % above the speed at which the beam buckles. add_cardan_beam does
/// not know the rotor speed, so it cannot warn: the caller must check.                             [docs/partitions.md]
/// @param root_radius  of the beam's root from the axis of rotation, which is perpendicular to the beam, m
/// @throws InputError: a radius that is not finite
double centrifugal_limit(const CardanBeam& beam, double root_radius);

}  // namespace cardan
