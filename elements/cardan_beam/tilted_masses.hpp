/// @file
/// Masses off the hinge line of elements that give way in shear.                           [docs/theory.md, any
/// section]
#pragma once

#include "elements/cardan_beam/partition.hpp"

namespace cardan {

/// Of the rotation of the bodies between the hinges against the sections, the share that is shear, in the directions
/// (y, z) of deflection: with h^2 GA / 12 EI = a, 1 / (1 + a) on a uniform element with hinges at delta_gauss. Zero for
/// an element rigid in shear.
Eigen::Matrix2d part_of_shear(const ElementLine& on, const Hinges& hinges);

/// Shear turns the bodies between the hinges and not the sections, so that masses beside the axis would move along it
/// too far. Of the first moments across the axis of B2 and B3, the share of shear goes to B1 and B4, which turn with
/// the sections, as far as these stay possible material. Kept: all masses and their places along the axis, first moment
/// and second moments across the axis of B1 with B2 and of B3 with B4.
/// @return share of the first moments that shear goes on tilting since that is not possible, 0 ... 1
double take_masses_off_the_tilt(const ElementLine& on, ElementInertia& element);

}  // namespace cardan
