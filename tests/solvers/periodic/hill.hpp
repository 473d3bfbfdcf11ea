/// @file
/// Hill's method: exponents of a linear periodic system from the harmonic balance of its solutions, to compare those of
/// floquet() with.
#pragma once

#include "solvers/periodic/floquet.hpp"

namespace cardan::testing {

struct HillOptions {
    int harmonics = 10;  ///< of the periodic vectors, on each side
    int samples = 0;     ///< of the coefficients per period; 0: 8 (harmonics + 1), at least 64
    Matrix weight = {};  ///< as in FloquetOptions
};

/// x = exp(lambda t) sum_j c_j exp(i j omega t), |j| <= H, in E x' = A x with the Fourier coefficients E_j, A_j:
///
///     sum_l [(lambda + i l omega) E_{j-l} - A_{j-l}] c_l = 0   for |j| <= H,
///
/// an eigenvalue problem of (2 H + 1) times the states. Every exponent occurs 2 H + 1 times, shifted by multiples of i
/// omega; the copy whose energy-weighted centre of harmonics is closest to zero is kept, since truncation affects it
/// least.
///         [Hill 1886; Moore, Floquet theory as a computational tool, SIAM J. Numerical Analysis 42 (2005) 2522-2568]
///
/// No integration, no steps: an independent check of floquet(). Exact apart from neglected harmonics, for any
/// frequency; vectors with more than H harmonics are wrong. `error` and `condition` of the modes are not known. Cost
/// about 10 (states (2 H + 1))^3: for small systems.
/// @throws InputError for numbers out of range; NumericalError if the iteration fails or if not as many exponents are
/// found as there are states (too few harmonics)
solvers::Floquet hill(const solvers::PeriodicSystem& system, const HillOptions& options = {});

}  // namespace cardan::testing
