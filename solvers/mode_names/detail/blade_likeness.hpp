/// @file
/// Whether the blades of a rotor are alike, and where they stand.
#pragma once

#include "mbs/kernels/kinematics.hpp"
#include "mbs/model/rotor_map.hpp"
#include "solvers/linear/linearise.hpp"

#include <vector>

namespace cardan::solvers {

/// Angle of every blade about the rotor axis, from the first one, rad: of the joint that is farthest from the axis.
/// Evenly spaced if all joints lie on it.
std::vector<double> blade_angles(const Kinematics& kin, const RotorMap& rotor);

/// True if the blades, undeformed, have the same number of coordinates with the same roles, the same inertia, springs
/// and dampers in them (to 1e-7), and if joints and axes come to lie on one another when turned about the rotor axis.
/// @param lin  for springs and dampers; linear ones are the same everywhere
bool blades_alike(const Model& model, const RotorMap& rotor, const Linearisation& lin);

}  // namespace cardan::solvers
