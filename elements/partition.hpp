/// @file
/// How the mass of a beam element is given to its four rigid bodies.
#pragma once

#include "elements/timoshenko.hpp"
#include "mbs/inertia.hpp"

#include <array>

namespace cardan {

enum class Partition : std::uint8_t {
    segment_masses,  ///< true mass, centre and tensor of each segment; with delta_gauss O(h^4) in bending, safe on
                     ///< tapered blades
    static_moment    ///< linear momentum of the static shapes of the hinges kept; for delta = 1/6; not on strong taper
};

/// Inertias of the bodies B1 ... B4 in beam axes, origin at the inboard end of the element.
struct ElementInertia {
    std::array<RigidInertia, 4> body;
    Hinges hinges = Hinges::symmetric(delta_gauss);
    double mass = 0;           ///< of the element, kg
    double polar_inertia = 0;  ///< int (Jxx + mu (y^2 + z^2)) dx about the reference line, kg m^2
    std::string warning = {};  ///< empty, or what is unsound about the partition here
};

/// Bodies of the element [x0, x0 + L] of a line, hinges at delta L and (1 - delta) L. Sectional rotary inertia goes to
/// the terminal bodies: that of the left half to B1, of the right half to B4.
/// On a curve the segments are cut at the same fractions of the arc and keep their true mass, centre and tensor.
ElementInertia partition_element(const ElementLine& element, double delta, Partition partition);
ElementInertia partition_element(const BeamLine& line, double x0, double L, double delta, Partition partition);

}  // namespace cardan
