/// @file
/// Exact first derivatives of the recursions.
#pragma once

#include "mbs/kernels/dynamics.hpp"

namespace cardan {

/// Partial derivatives of the inverse dynamics tau = g qdd + Gamma qd qd with respect to q and qd
/// (with respect to qdd it is the metric). The recursion differentiated analytically, with S_j the twist of coordinate
/// j, v and a the spatial velocity and acceleration of what carries it, Psi' = v x S and Psi'' = a x S + v x Psi'; for
/// k distal to or equal to j, over the subtree of k with inertia I and inertial force f,
///
///     d tau_k / d q_j  = 2 S_k . B Psi'_j + S_k . I Psi''_j
///
///     d tau_j / d q_k  = S_j . (2 B Psi'_k + I Psi''_k + S_k x* f)
///
///     d tau_k / d qd_j = 2 S_k . (B S_j + I Psi'_j)
///
///     d tau_j / d qd_k = 2 S_j . (B S_k + I Psi'_k)
///
///                                                                  [Singh, Russell and Wensing 2022, section IV]
/// B maps a twist with angular part w to the forces m w x x_dot of the mass points; twelve numbers of a subtree
/// determine it, its momentum and the moment sum m x x_dot^T (docs/theory.md).
/// @param dtau_dq, dtau_dqd  out, n x n, overwritten; two different matrices
///
/// Cost O(n d) and n^2 zeros, no allocation.
void inverse_dynamics_derivatives(const Kinematics& kin, VectorIn qd, VectorIn qdd, MatrixOut dtau_dq,
                                  MatrixOut dtau_dqd);
/// Derivatives without the zeros between branches.
void inverse_dynamics_derivatives(const Kinematics& kin, VectorIn qd, VectorIn qdd, BranchMatrix& dtau_dq,
                                  BranchMatrix& dtau_dqd);

}  // namespace cardan
