/// @file
/// Hinge positions chosen from the bending compliance c(x) of an element.
#pragma once

#include "elements/cardan_beam/detail/planar_element.hpp"

namespace cardan {

/// Positions of both hinges, m from the inboard end; inside the element and at least 0.05 of its length apart. In an
/// element rigid in bending they are at delta_gauss.
struct HingePlaces {
    double first, second;
};

/// The Gauss points of the weight c: the two hinges reproduce the compliance of the element and its first, second and
/// third moments. c = const: delta_gauss.
HingePlaces compliance_gauss_points(const PlanarElement& element);

/// The mean-difference points: a polyline kinked there has the mean square slope of the element under a constant
/// moment, and the same mean product of slopes under a constant and a linear one.      [docs/partitions.md, step 1]
/// c = const: 1/6 and 5/6. Falls back to the Gauss points if the hinges would lie outside the element or too close
/// together, which happens only with a pronounced soft spot.
HingePlaces mean_difference_points(const PlanarElement& element);

}  // namespace cardan
