/// @file
/// Masses off the hinge line of elements that are flexible in shear.                           [docs/theory.md, any
/// section]
#pragma once

#include "elements/cardan_beam/partition.hpp"

namespace cardan {

/// The fraction of the rotation of the bodies between the hinges, relative to the sections, that is due to shear, in
/// the directions (y, z) of deflection: with h^2 GA / 12 EI = a, 1 / (1 + a) on a uniform element with hinges at
/// delta_gauss. Zero for an element rigid in shear.
Eigen::Matrix2d shear_fraction(const ElementLine& on, const Hinges& hinges);

/// Shear turns the bodies between the hinges but not the sections, so masses off the axis would move too far along it.
/// The shear fraction of the lateral first moments of B2 and B3 is therefore transferred to B1 and B4, which turn with
/// the sections, as far as their inertias stay physically possible. Preserved: all masses and their positions along the
/// axis, and the first and second moments across the axis of B1 with B2 and of B3 with B4.
/// @return fraction of the first moments that shear still tilts because the transfer is not possible, 0 ... 1
double shift_tilted_masses(const ElementLine& on, ElementInertia& element);

}  // namespace cardan
