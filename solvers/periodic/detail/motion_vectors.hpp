/// @file
/// Properties of one motion by its vectors at some times of the period.
#pragma once

#include "solvers/algebra/product_eigen.hpp"
#include "solvers/periodic/periodic_system.hpp"

namespace cardan::solvers {

/// Fraction of the states beside the coordinates in the products of left and right vectors, which are 1; all over the
/// period, since they pass it on to the coordinates and back.
double state_share(const PeriodicSystem& system, const ProductEigen::Vectors& vectors);

/// Kinetic energy over that of the positions taken for rates: a mean of the squares of the frequencies of its
/// harmonics, in which slow ones weigh most. A harmonic with the share s of the kinetic energy is as fast at least as s
/// times this.
/// @param inertia  at the times of the vectors (q, q')
double mean_square_frequency(const std::vector<Matrix>& inertia, const ProductEigen::Vectors& vectors);

}  // namespace cardan::solvers
