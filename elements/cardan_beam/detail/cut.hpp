/// @file
/// Places on a beam and the rigid segments they belong to. Internal to sections and stations: not installed.
#pragma once

#include "elements/cardan_beam/cardan_beam.hpp"

namespace cardan {

/// A place on an element and the rigid segment it belongs to.
struct Cut {
    const CardanBeam::Element* element = nullptr;
    ElementLine line;
    std::size_t segment = 0;  ///< 0 ... 3
    double s = 0, x = 0;      ///< along the reference line; along the chord; m
};

/// @param s  arc length along the reference line; at a node: in the element inboard of it
/// @throws InputError if it lies outside the beam
Cut cut_at(const CardanBeam& beam, double s);

}  // namespace cardan
