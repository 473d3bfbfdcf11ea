/// @file
/// The Riemannian metric of the configuration space, g_ab.
#pragma once

#include "mbs/kernels/branch_matrix.hpp"
#include "mbs/kernels/composites.hpp"

#include <optional>

namespace cardan {

/// Metric, armatures and added mass included.
///
///     g_ab = sum_k m_k u_ka . u_kb + Omega_ka . J_k Omega_kb      [Zhao et al. 2007, eq. 8]
///
/// The sum over k collapses to one composite rigid body per pair, the subtree of the more distal coordinate.
/// @param g  out, n x n, full and symmetric, kg m^2, kg m or kg; overwritten
///
/// Cost O(n d), d the depth of the tree, and n^2 zeros; no allocation.
/// @throws InputError if g has the wrong size or belongs to another model, as do all functions here
template <class S>
void metric(const KinematicsT<S>& kin, MatrixOutT<S> g);
/// The metric without the zeros between branches, which in large trees cost more than the entries.
void metric(const Kinematics& kin, BranchMatrix& g);

/// Adds J s s^T of every armature to a metric.
template <class S>
void add_armatures(const Model& model, MatrixOutT<S> g);

/// First pivot of a Cholesky factorisation of g that is below 1e-12 of its scale.
/// @param scale  size n; a magnitude that does not vanish with g_aa itself
struct SingularPivot {
    int index;
    double value, scale;
};
std::optional<SingularPivot> singular_pivot(const Matrix& g, const Vector& scale);

/// Kinetic energy (1/2) g_ab qd^a qd^b in O(n), J.
double kinetic_energy(const Kinematics& kin, VectorIn qd);

}  // namespace cardan
