/// @file
/// The mean-difference partition of an element in one bending plane. Formulas: docs/partitions.md.
#pragma once

#include "elements/cardan_beam/detail/compliance_hinges.hpp"

namespace cardan {

/// Integrals of mu with the static shapes of the hinges: p2 is the deflection for a unit rotation of hinge 2 with the
/// inboard end held, p1 that for hinge 1 with the outboard end held.
struct HingeShapes {
    double P2, Q1;    ///< int mu p2, int mu p1: first moments of B4 and B1 about their hinges that have this momentum
    double M22, M11;  ///< int mu p2^2, int mu p1^2
    double L2, L1;    ///< int mu p2 (x - x2), int mu p1 (x1 - x)
};
HingeShapes hinge_shapes(const PlanarElement& element, const HingePlaces& hinges);

/// A rigid body on the axis.
struct PlanarBody {
    double mass, x, J;  ///< kg; centre, m; about it, kg m^2
};

struct MeanDifference {
    HingePlaces hinges;
    std::array<PlanarBody, 3> body;  ///< B1, B2 + B3, B4
    double limiter;                  ///< 1: momenta of the static shapes; 0: true segments; in between: a blend
    double gauge;                    ///< 1: masses of the end bodies near those of the true segments
};
/// @param element  with mass
MeanDifference mean_difference(const PlanarElement& element);

}  // namespace cardan
