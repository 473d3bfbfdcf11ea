/// @file
/// Frequencies and bent shapes of beams by the cardanic element and by the mixed one.
#pragma once

#include "examples/studies/beam_accuracy/hermite_beam.hpp"
#include "examples/studies/beam_accuracy/method.hpp"

namespace cardan::accuracy {

std::vector<double> equal_ends(double length, int elements);
/// Equal phase of a travelling flap wave, int (mu / EI)^(1/4) dx.
std::vector<double> equal_phase_ends(const BeamLine& line, int elements);

/// Bending modes by any method.
/// @throws Error if the method refuses the beam (negative inertia, mass matrix not positive definite)
BendingModes bending_modes(const Method& method, const Beam& beam, const std::vector<double>& ends);

/// Lowest torsion frequency of a clamped beam, rad/s; chain or mixed.
double torsion_frequency(const Method& method, const BeamLine& line, int elements);

/// Critical dead tip load along a clamped beam, in the flap plane.
double buckling_load(const Method& method, const BeamLine& line, int elements);

struct TipLoad {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  ///< dead, beam axes
    int steps = 10;
    bool extension = false, torsion = false;  ///< free, else condensed
};
/// Place of the tip of a clamped beam, beam axes; chain, mixed or corotational (plane x-z).
Vec3 loaded_tip(const Method& method, const BeamLine& line, int elements, const TipLoad& load);

}  // namespace cardan::accuracy
