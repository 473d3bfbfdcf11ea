/// @file
/// The rotor speed above which a beam of cardanic elements is not stiff any more.
#pragma once

#include "elements/cardan_beam/cardan_beam.hpp"

namespace cardan {

/// Smallest spin, rad/s, at which the centrifugal force takes all stiffness from a hinge of the beam; infinity if there
/// is none.
///
/// With Partition::mean_difference on an element that falls off in stiffness the centre of mass of the last body lies
/// inboard of its hinge: the centrifugal force turns it away instead of straightening it. That is a property of the
/// discretisation, not of the beam: the limit rises with the number of elements; frequencies above half of it are to be
/// mistrusted. True segments have no limit.
///
/// Estimate from every hinge alone, in its softest direction, whether that bends in the plane of rotation or out of it,
/// with the masses at the radius root_radius + x: from 2 % below to 5 % above the speed at which the beam gives way.
/// The caller knows the rotor speed: add_cardan_beam does not and gives no warning.                [docs/partitions.md]
/// @param root_radius  of the beam's root from the axis of rotation, which is perpendicular to the beam, m
/// @throws InputError: a radius that is not finite
double centrifugal_limit(const CardanBeam& beam, double root_radius);

}  // namespace cardan
