/// @file
/// Static shapes of the hinges of an element in one bending plane, on which its masses and loads do work.
#pragma once

#include "elements/cardan_beam/detail/compliance_hinges.hpp"

namespace cardan {

/// Deflections and section rotations at PlanarElement::x() for a unit rotation of a hinge, without loads in between.
/// With psi_j = int (x - xi) N_j c dxi + sigma_j / d int s dxi and F their flexibility the shapes of the
/// hinges, inboard end held, are phi_i = (F^-1)_ij psi_j.                                       [docs/partitions.md,
/// step 2]
struct StaticShapes {
    using Samples = PlanarElement::Samples;
    Samples last, first;            ///< hinge 2, inboard end held: phi_2; hinge 1, outboard end held: phi_1 - (x - x1)
    Samples last_turn, first_turn;  ///< positive as B4 turns, 0 ... 1; as B1 turns against it, 1 ... 0
};
/// @param element  not rigid in bending
StaticShapes static_shapes(const PlanarElement& element, const HingePlaces& hinges);

}  // namespace cardan
