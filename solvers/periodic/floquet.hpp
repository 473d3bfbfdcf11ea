/// @file
/// Floquet theory: multipliers, exponents, periodic eigenvectors and principal frequencies of linear periodic systems.
#pragma once

#include "solvers/periodic/floquet_mode.hpp"
#include "solvers/periodic/transition.hpp"

namespace cardan::solvers {

struct FloquetOptions {
    TransitionOptions transition = {.stages = 7};
    /// Integrates over T/Q only: Phi(T) = P^-Q (P Phi(T/Q))^Q                        [Peters 1994; Lee et al., eq. 18]
    BladeSymmetry symmetry = {};
    /// Steps per period; 0: by the error of the method at the frequency `per_period`, then doubled until the exponents
    /// of all resolved modes with a principal frequency up to `per_period` times 2 pi / T have an estimated error below
    /// `tolerance` times the larger of 2 pi / T and |exponent|, or `max_steps` is reached.
    int steps = 0;
    double per_period = 10, tolerance = 1e-9;
    int max_steps = 4096;
    /// The monodromy matrix is kept as a product of this many factors (per T/Q): strongly damped motions keep their
    /// accuracy, and the vectors are obtained at the times in between.
    int factors = 8;
    /// Only motions up to `per_period`, and up to half as fast again, are of interest: of a system of second order
    /// those that are much faster are left out of the result. Where they can be distinguished from the others
    /// beforehand (without states beside the coordinates, and with a gap in the frequencies at every azimuth), the rest
    /// is integrated alone. The rest keeps its exponents: what they are off by is part of their errors.
    bool only_slow = false;
    /// Weight W of x^H W x for the participation of harmonics in a system of first order; empty: unit matrix.
    Matrix weight = {};
};

/// Result of floquet().
struct Floquet {
    double period = 0;  ///< s
    /// Sorted by principal frequency, then by growth; one of every complex conjugate pair.
    std::vector<FloquetMode> modes;
    /// Motions too fast for the samples over the period: their frequencies are aliased and their decay is that of the
    /// integration method. A larger FloquetOptions::per_period resolves them. (Detected in second-order systems only.)
    std::vector<FloquetMode> unresolved;
    int steps = 0;  ///< per period, of the finest integration; 0: none
    /// Number of multipliers that are zero or indistinguishable from rounding: algebraic states, and motions that are
    /// damped out (by the integration method if they are too fast for its steps). They are not modes.
    int damped_out = 0;
    std::string note;  ///< which modes are not as accurate as wanted; usually empty

    /// Largest growth rate of all modes except rigid ones, 1/s; -infinity without any.
    double growth() const;
    /// Smallest decay rate, 1/s; negative: unstable.
    double stability_margin() const { return -growth(); }
};

/// Multipliers and vectors of the monodromy matrix, by integration over a period, or over its Q-th part with the blades
/// renumbered; the product is never formed (ProductEigen).
///
/// Errors of exponents are estimated from the integration with a third as many steps (half, where steps were doubled),
/// to first order in the difference, with the left eigenvectors, and from the method's error at the frequencies of the
/// mode's harmonics; for a mode of frequency f they fall like (f / steps)^(2 stages). Seven stages with three or four
/// steps per period of the fastest wanted mode cost least. Rounding adds about
/// 1e-15 times the condition number: a defective double multiplier (free yaw) splits by some 1e-8 per period.
/// Motions too fast for the steps are not resolved: the method damps them, and their stability remains unknown.
///
/// Cost for n coordinates and s stages: 2/3 (s n)^3 + 4 s^2 n^3 per step and 30 factors (2 n)^3 per refinement. Where
/// the coefficients vary in r < n/2 directions only, as those of a rotor on a tower without gravity do, a step of
/// Radau's method costs 8/3 (s r)^3 + 8 (s r)^2 n + 8 s r n^2.
///
/// @throws InputError for options out of range, and if the system does not have the symmetry (asymmetry() above 1e-7);
/// NumericalError for coefficients that are not finite, and if the eigenvalue iteration fails
Floquet floquet(const PeriodicSystem& system, const FloquetOptions& options = {});

}  // namespace cardan::solvers
