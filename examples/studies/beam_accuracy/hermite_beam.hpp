/// @file
/// The usual finite element beside which the joint chain is seen: consistent matrices of cubic or static shapes.
///
/// Per node and plane two unknowns, displacement and rotation. Stiffness, mass and geometric stiffness are integrals of
/// the shape functions over the true section data (12 Gauss points between all breaks); the tension is exact inside the
/// element. Extended precision, so that the solution is good for reference values: the stiffness of 256 elements has a
/// condition of 1e10.
#pragma once

#include "examples/studies/beam_accuracy/shapes.hpp"

namespace cardan::accuracy {

/// A clamped beam that spins about z, steady state straight along x: inextensible, torsionally rigid, mass on the line.
struct Beam {
    BeamLine line;
    Plane plane = Plane::flap;
    double speed = 0;       ///< rad/s
    double hub_radius = 0;  ///< m
};

struct BendingModes {
    std::vector<double> flap, edge;  ///< rad/s, ascending; by the larger share of energy
};

/// @param ends  of the elements, from 0 to the length
BendingModes hermite_modes(const Beam& beam, const std::vector<double>& ends, Shapes shapes = Shapes::cubic,
                           int count = 6);

/// Critical dead tip load along the beam at rest.
double hermite_buckling(const Beam& beam, const std::vector<double>& ends);

/// Frequencies of cubic elements by `elements` and twice as many elements (all breaks of the line are ends as well),
/// extrapolated with order 4: good for ten digits.
BendingModes hermite_limit(const Beam& beam, int elements = 96);

}  // namespace cardan::accuracy
