/// @file
/// The forearm of the six-axis arm: a tube, its exact vibrations with a rigid body at the tip, and the arm that has it
/// as a flexible beam.
#pragma once

#include "elements/cardan_beam/cardan_beam.hpp"
#include "mbs/urdf/urdf.hpp"

#include <vector>

namespace arm {

/// The tube between the frames forearm_root and forearm_tip of examples/data/arm6.urdf.
struct Tube {
    double length = 0.8, outer = 0.12, wall = 0.005;  ///< m
    double E = 70e9, G = 26.5e9, density = 2700;      ///< Pa, Pa, kg/m^3
    double shear_factor = 0.5;                        ///< of a thin round tube

    double area() const;    ///< m^2
    double second() const;  ///< second moment of area, m^4
    double mass() const { return density * area() * length; }
    cardan::BeamLine line() const;
};

/// A rigid body at the tip of the tube: mass, distance of its centre from the tip along the tube, inertia about its
/// centre and a lateral axis.
struct TipBody {
    double mass, centre, inertia;
};

/// Lowest natural frequency (Hz) of the tube, clamped at its root, with the tip body, in one plane: a Timoshenko beam
/// by its transfer matrix, exact.
double clamped_frequency(const Tube& tube, const TipBody& body);

struct FlexibleArm {
    cardan::Tree tree;
    cardan::ForceSet forces;             ///< the springs of the beam
    std::vector<cardan::BodyId> drives;  ///< by body of the rigid arm
    cardan::CardanBeam beam;
};
/// The rigid arm with the inertia of its link "forearm_tube" replaced by a beam from "forearm_root" to "forearm_tip".
FlexibleArm flexible_arm(const cardan::Tree& rigid, const Tube& tube, int elements);

/// All that the tip of the tube carries at q = 0, as one rigid body in the axes of "forearm_tip".
cardan::RigidInertia carried_by_tip(const cardan::Tree& rigid);
/// Inertia of the link "forearm_tube" in its own frame.
cardan::RigidInertia tube_in_file(const cardan::Tree& rigid);

}  // namespace arm
