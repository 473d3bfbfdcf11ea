/// @file
/// Inertias of bodies and subtrees in base axes: computed once per configuration for the kernels that share them.
#pragma once

#include "mbs/kernels/kinematics.hpp"

namespace cardan {

/// Inertia tensors of the bodies about their centres of mass, base axes. Idempotent per q.
template <class S>
void body_inertias(const KinematicsT<S>& kin);

/// Masses and centres of the subtrees alone. Idempotent per q.
template <class S>
void subtree_centres(const KinematicsT<S>& kin);

/// Subtrees as composite rigid bodies (mass, centre, Binet tensor about the centre), tip to base, and their added mass.
/// Idempotent per q.
template <class S>
void composites(const KinematicsT<S>& kin);

}  // namespace cardan
