/// @file
/// Steps and samples of a Floquet analysis.
#pragma once

#include "solvers/periodic/floquet.hpp"

namespace cardan::solvers {

/// Grid of a Q-th of the period: samples, of which each factor of the product takes as many, and steps in each; 0: to
/// be refined, from one step in `first_ratio` samples to one in each, then doubled.
struct FloquetGrid {
    /// Ratio of the steps of the first two integrations, whose difference shows the error of the second one.
    static constexpr int first_ratio = 3;
    int samples, factors, steps;
};

FloquetGrid floquet_grid(const FloquetOptions& options);

/// Relative error of one step of Radau's method for x' = lambda x, |lambda| h = z: that of its approximation of exp(z).
double radau_step_error(double z, int stages);

}  // namespace cardan::solvers
