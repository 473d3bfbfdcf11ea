/// @file
/// Critical loads: linear buckling under conservative loads.
#pragma once

#include "mbs/system/system.hpp"

#include <vector>

namespace cardan::solvers {

struct BucklingOptions {
    int count = 1;        ///< number of factors wanted
    bool gravity = true;  ///< gravity is one of the loads that are scaled; otherwise it acts in full
    Vector at = {};       ///< state q at which the stiffnesses are taken; empty: zero
};

struct BucklingMode {
    double factor;  ///< on the loads
    Vector shape;   ///< over all coordinates, rad or m; largest entry 1
};

/// Linear buckling at standstill: (K_elastic + factor K_loads) shape = 0 with both stiffnesses at one state, so that
/// K_loads is the change of stiffness per unit load: the stiffness of the loads themselves and, to first order, the
/// change of the elastic stiffness due to the deflection under them. In joint coordinates the elastic stiffness of
/// beams rigid in shear is constant; for beams flexible in shear with extension free it depends on the axial force.
/// Neglected is the change of the load stiffness due to prebuckling deflection, which is of second order in the load.
/// Dense symmetric eigenproblem over the free coordinates.
///
/// Entries at the rounding level of the terms that make up the stiffness of wrenches and gravity (1e-13 of their
/// magnitude) count as zero, so loads that cannot buckle the structure have no factor rather than one of 1e16. For user
/// forces these terms are not known: a zero Jacobian should be exactly zero.
/// @return the lowest positive factors in ascending order; fewer than `count` (or none) if there are no more
/// @throws InputError if count < 1, if `at` has the wrong size or is not finite, or if K_loads is not symmetric (1e-7
/// of its norm): follower forces and moments about fixed axes have no potential, may cause flutter without an adjacent
/// equilibrium, and need load_stability().
/// @throws NumericalError if the structure without these loads is not stable.
[[nodiscard]] std::vector<BucklingMode> linear_buckling(const System& system, const BucklingOptions& options = {});

}  // namespace cardan::solvers
