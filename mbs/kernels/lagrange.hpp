/// @file
/// Lagrange's equations as they are printed, sums over bodies of products of the kinematic basis functions:
///
///     g_ab qdd^b + Gamma_abc qd^b qd^c = Q_a        a = 1 ... n, summed over b and c     [Zhao et al. 2007, eq. 4]
///
/// The units are those of the coordinates (rad or m): Q_a is in N m where joint a turns and in N where it slides, g_ab
/// in kg m^2, kg m or kg, Gamma_abc in those of g_ab per unit of q^c.
///
/// Slow (O(n^4) for all symbols) and plain: the recursive kernels are tested against them, and a reader finds the
/// equations here.
#pragma once

#include "mbs/kernels/kinematics.hpp"

#include <span>

namespace cardan::lagrange {

/// Metric.
///
///     g_ab = sum_{k in sub(a) and sub(b)} m_k u_ka . u_kb + Omega_ka . J_k Omega_kb  (+ armatures)      [eq. 8]
template <class S>
S metric(const KinematicsT<S>& kin, int a, int b);

/// Christoffel symbol of the first kind, symmetric in b and c.
///
///     Gamma_abc = (1 - s_b) sum_k m_k u_ka . (Omega_kb x u_kc) + (P_k Omega_kb) . (Omega_kc x Omega_ka)  for b <= c
///
/// P_k is Binet's tensor and is contracted with the proximal index b.      [eq. 9, corrected]
template <class S>
S christoffel_first_kind(const KinematicsT<S>& kin, int a, int b, int c);

/// Applied force at the centre of mass and applied moment on a body, in its own components.
struct BodyLoad {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
};

/// Generalised force.
///
///     Q_a = sum_{k in sub(a)} K_k . u_ka + M_k . Omega_ka      [eq. 7]
///
/// @param loads  one per body
double generalised_force(const Kinematics& kin, std::span<const BodyLoad> loads, int a);

/// Left-hand side of equation a: g_ab qdd^b + Gamma_abc qd^b qd^c.                                       [eq. 4]
/// @param qd, qdd  rates and accelerations of all coordinates, size n
double left_hand_side(const Kinematics& kin, VectorIn qd, VectorIn qdd, int a);

}  // namespace cardan::lagrange
