// A thin flat plate: its polar, and how its air lags.
#pragma once

#include "elements/aerodynamics/unsteady_airfoil.hpp"
#include "mbs/base/types.hpp"

namespace cardan::testing {

/// Lift 2 pi alpha up to 40 degrees, no drag, no moment about the quarter chord.
inline Polar flat_plate_polar() {
    constexpr double end = 0.7;
    return {"flat plate", {-pi, -end, end, pi}, {0, -2 * pi * end, 2 * pi * end, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}};
}

/// Its flow is attached up to there.
inline UnsteadyAirfoil flat_plate(double A1, double A2, double b1, double b2) {
    const AttachedFlow flow{.slope = 2 * pi, .upper = 0.7, .lower = -0.7};
    return {flat_plate_polar(), flow, {.A1 = A1, .A2 = A2, .b1 = b1, .b2 = b2}};
}
/// [R. T. Jones, NACA Report 681, 1940]
inline UnsteadyAirfoil flat_plate_by_jones() {
    return flat_plate(0.165, 0.335, 0.0455, 0.3);
}
/// The lift follows at once.
inline UnsteadyAirfoil quasi_steady_plate() {
    return flat_plate(0, 0, 1, 1);
}

/// Air that moves with a plate, per length: pi rho b^2 across the chord at its middle, pi rho b^4 / 8 about the span.
/// With it the lift pi T_u omega of an airfoil and its moment -pi/2 T_u omega are Theodorsen's terms without
/// circulation.
struct AirMass {
    double mass, inertia;  ///< kg/m, kg m
    AirMass(double density, double half_chord)
        : mass(pi * density * half_chord * half_chord), inertia(mass * half_chord * half_chord / 8) {}
};

}  // namespace cardan::testing
