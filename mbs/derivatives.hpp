/// @file
/// Exact first derivatives of the recursions.
#pragma once

#include "mbs/dynamics.hpp"

namespace cardan {

/// Partial derivatives of the inverse dynamics tau = g qdd + Gamma qd qd with respect to q and qd
/// (with respect to qdd it is the metric). The recursion differentiated analytically in spatial vector form; the
/// composite bodies carry inertia, velocity matrix B = (v x* I - I v x + (I v) xbar*) / 2 and force.
///                                                                  [Singh, Russell and Wensing 2022, section IV]
/// @param dtau_dq, dtau_dqd  out, n x n, overwritten
/// Cost O(n d), no allocation.
template <class S>
void inverse_dynamics_derivatives(const KinematicsT<S>& kin, VectorInT<S> qd, VectorInT<S> qdd, MatrixOutT<S> dtau_dq,
                                  MatrixOutT<S> dtau_dqd);

}  // namespace cardan
