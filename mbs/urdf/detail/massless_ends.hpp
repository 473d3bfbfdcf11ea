/// @file
/// Links that move at the end of a branch without an inertia. Internal to cardan::urdf.
#pragma once

#include "mbs/urdf/urdf.hpp"

namespace cardan::urdf_impl {

/// Whether each body, or one that it carries, has an inertia.
std::vector<bool> carries_inertia(const Tree& tree);

/// Makes the metric of the tree regular in the coordinate of a body without inertia whose joint mimics another: the
/// coordinate gets an armature J, and that of the joint at the end of the chain of mimics, q = m q' + offset, gets
/// -J m^2. Where mimic_couplings() hold, the sum of their kinetic energies is zero, so the motion is that without
/// either. J m^2 is 1e-6 of the inertia that the other joint's own link has in its coordinate.
/// @return what was done, for a note; empty if the joint mimics none, or one whose own link has no inertia
std::string couple_massless_end(UrdfModel& robot, int body);

}  // namespace cardan::urdf_impl
