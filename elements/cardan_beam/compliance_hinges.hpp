/// @file
/// Where the hinges of an element stand that follow its bending compliance c(x).
#pragma once

#include "elements/cardan_beam/planar_element.hpp"

namespace cardan {

/// Places of both hinges, m from the inboard end; inside the element and at least 0.05 of its length apart. An element
/// that does not bend has them at delta_gauss.
struct HingePlaces {
    double first, second;
};

/// The Gauss points of the weight c: the two hinges and the element have the same compliance, its first, second and
/// third moment. c = const: delta_gauss.
HingePlaces compliance_gauss_points(const PlanarElement& element);

/// The mean-difference points: a polyline kinked there has the mean square slope of the element under a constant
/// moment, and the same mean product of slopes under a constant and a linear one.      [docs/partitions.md, step 1]
/// c = const: 1/6 and 5/6. The Gauss points if they lie outside the element or too close, which takes a soft spot.
HingePlaces mean_difference_points(const PlanarElement& element);

}  // namespace cardan
