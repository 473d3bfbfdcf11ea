/// @file
/// The slow motions of a linear periodic system as a smaller system of their own.
#pragma once

#include "solvers/periodic/periodic_system.hpp"

#include <optional>

namespace cardan::solvers {

/// Motions of M q'' + C q' + K q = 0 with n coordinates that are slower than all others, without an approximation: q =
/// X(t) z + Y(t) z', q' = V(t) z + W(t) z' and z'' = -b(t) z' - a(t) z with m < n coordinates z, all matrices of period
/// T. That q' is the derivative of q and obeys the equations means
///
///     V = X' - Y a,                          W = X + Y' - Y b,
///     M (V' - W a) + C V + K X = 0,          M (V + W' - W b) + C W + K Y = 0.
///
/// Multipliers and motions of the small system are multipliers and motions of the whole.
class SlowMotions {
public:
    /// Fourier collocation. The slow eigenspace of K and M at every azimuth is the first approximation; what it leaves
    /// is taken away along the fast eigenvectors, again and again (accelerated, see Anderson), which converges where
    /// the two groups of frequencies are further apart than the harmonics in X. These are estimated from the
    /// eigenvectors.
    ///
    /// @param system     positive definite M, no states beside the coordinates
    /// @param symmetry   of the system; P need not be orthogonal, but M(t + T/Q) = P^T M(t) P
    /// @param frequency  rad/s: motions up to it are among the slow ones
    /// @param tolerance  of error()
    /// @returns none if there is no such gap, if too few motions are fast to be worth it, or if the equations do not
    /// hold to the tolerance between the azimuths of the collocation as well
    ///
    /// Cost: at up to 192 azimuths over Q 10 n^3 once and 12 n^2 m per iteration, of which there are ten to twenty; of
    /// none at 48 azimuths over Q 10 n^3.
    static std::optional<SlowMotions> find(const PeriodicSystem& system, const BladeSymmetry& symmetry,
                                           double frequency, double tolerance);

    /// z, unit mass matrix.
    const PeriodicSystem& system() const { return system_; }
    /// Blade symmetry of the whole, of z.
    const BladeSymmetry& symmetry() const { return symmetry_; }
    /// [X Y; V W]: (q, q') of (z, z').
    Matrix expansion(double time) const;
    /// Largest relative difference in the equations of z, between the azimuths of the collocation: twice the relative
    /// error of frequencies of one per period and more, twice the error over 2 pi / T of slower ones.
    double error() const { return error_; }

    /// Azimuths of the collocation, per period.
    int azimuths() const { return static_cast<int>(2 * (series_.cols() - 1)); }

private:
    friend class SlowSearch;
    SlowMotions(PeriodicSystem system, BladeSymmetry symmetry, Matrix series, Eigen::Index rows, double error)
        : system_(std::move(system)),
          symmetry_(std::move(symmetry)),
          series_(std::move(series)),
          rows_(rows),
          error_(error) {}

    PeriodicSystem system_;
    BladeSymmetry symmetry_;
    Matrix series_;      // of X, Y, V, W below one another, each by columns: Fourier coefficients by column
    Eigen::Index rows_;  // n
    double error_;
};

}  // namespace cardan::solvers
