/// @file
/// Transition matrices of linear periodic systems.
#pragma once

#include "solvers/periodic/periodic_system.hpp"

namespace cardan::solvers {

enum class TransitionMethod : std::uint8_t {
    radau,    ///< Radau IIA: order 2 stages - 1, L-stable
    midpoint  ///< E(t_m) (x_f - x_i) / h = A(t_m) (x_f + x_i) / 2 [Lee et al. 2002, eq. 19]: second order; a constant
              ///< system's frequency f comes out as (N / pi) atan(pi f / N), both per period, with N steps per period
};

struct TransitionOptions {
    TransitionMethod method = TransitionMethod::radau;
    int stages = 5;  ///< of Radau's method, 1 ... 9
};

/// x(t1) = Phi x(t0) over `intervals` equal parts of [t0, t1], one matrix for each, with `steps` equal steps in each.
/// States are (q, q', s) for a second-order system. Cost per step: an elimination of stages * n rows (second order; n
/// counts coordinates and states beside them), stages * states rows (first order), or states rows (midpoint).
/// @throws InputError for numbers < 1; NumericalError if a coefficient is not finite or a step has no solution
std::vector<Matrix> transitions(const PeriodicSystem& system, double t0, double t1, int intervals, int steps,
                                const TransitionOptions& options = {});

/// Phi(T, 0) by `steps` equal steps.
Matrix monodromy(const PeriodicSystem& system, int steps, const TransitionOptions& options = {});

}  // namespace cardan::solvers
