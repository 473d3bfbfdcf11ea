/// @file
/// Distribution of the mass of a beam element over its four rigid bodies.
#pragma once

#include "elements/cardan_beam/joint_stiffness.hpp"
#include "mbs/model/inertia.hpp"

#include <array>
#include <string_view>

namespace cardan {

enum class Partition : std::uint8_t {
    segment_masses,  ///< true mass, centre and tensor of each segment; with delta_gauss O(h^4) in bending, safe on
                     ///< tapered blades
    static_moment,   ///< linear momentum of the static shapes of the hinges kept; for delta = 1/6; not on strong taper
    compliance_gauss,  ///< segment masses, hinges at the Gauss points of the element's own bending compliance: on
                       ///< tapered beams at rest several times better than with delta_gauss; the same on uniform ones
    mean_difference    ///< hinges and bodies from the static shapes of the element as it is: O(h^4) also in rotation
                       ///< and buckling, on any taper (where EI falls a hundredfold within an element compliance_gauss
                       ///< is closer); mind centrifugal_limit. [docs/partitions.md]
};

/// Hinge position that suits a partition, as a fraction of the length; delta_gauss for partitions that place the hinges
/// themselves.
constexpr double recommended_delta(Partition partition) {
    return partition == Partition::static_moment ? 1. / 6 : delta_gauss;
}

/// "segment masses", "static moments", "compliance Gauss points", "mean differences".
std::string_view partition_name(Partition partition);
/// True if the partition places the hinges from the element's compliance, not at delta.
constexpr bool places_hinges(Partition partition) {
    return partition == Partition::compliance_gauss || partition == Partition::mean_difference;
}

/// Inertias of the bodies B1 ... B4 in beam axes, origin at the inboard end of the element.
struct ElementInertia {
    std::array<RigidInertia, 4> body;
    Hinges hinges = Hinges::symmetric(delta_gauss);
    double mass = 0;           ///< of the element, kg
    double polar_inertia = 0;  ///< int (Jxx + mu (y^2 + z^2)) dx about the hinge line, kg m^2
    std::string warning = {};  ///< empty, or what is unsound about the partition here
    /// To what extent B1 and B4 have the first moments of the static shapes: 1 fully, 0 those of the true segments.
    double shape_share = 0;
    double tilted_moment = 0;   ///< share of the first moments across the axis that shear tilts though the sections
                                ///< stay: more than 0 where the end bodies have not the rotary inertia to carry them
    double rotary_split = 0.5;  ///< place, as a fraction of the length, inboard of which the sectional rotary inertia
                                ///< is part of B1, beyond of B4
};

/// Bodies of the element [x0, x0 + L] of a line. On a curve the segments are cut at the same fractions of the arc and
/// keep their true mass, centre and tensor.
///
/// segment_masses and static_moment: hinges at delta L and (1 - delta) L. Sectional rotary inertia goes to the terminal
/// bodies: that of the left half to B1, of the right half to B4.
///
/// compliance_gauss and mean_difference: hinges from the bending compliance, delta is not used; sectional rotary
/// inertia is cut at the centroid of the torsion compliance, int x/GJ / int 1/GJ.
///
/// If sections are flexible in shear, first moments across the axis are moved from B2 and B3 to B1 and B4
/// (elements/cardan_beam/tilted_masses).
///
/// mean_difference: a body is the material of its segment, stretched along the axis about its centre and scaled in mass
/// until mass and moment of inertia are those of the partition, and moved along the axis to its place; across the axis
/// it keeps its centre and spread, so the tensor stays physical. Preserved exactly: mass, first moment in all
/// directions (a lateral deficit of the new masses is compensated by moving B2 and B3), and on a straight line also the
/// second moment along the axis.
ElementInertia partition_element(const ElementLine& on, double delta, Partition partition);
ElementInertia partition_element(const BeamLine& line, double x0, double L, double delta, Partition partition);

}  // namespace cardan
