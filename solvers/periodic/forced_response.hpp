/// @file
/// Periodic response of a linear system with periodic coefficients to a periodic load.
#pragma once

#include "solvers/periodic/periodic_system.hpp"

namespace cardan::solvers {

/// q(t) = h0 + sum_j hc_j cos j w t + hs_j sin j w t, w = 2 pi / T.
struct ForcedResponse {
    double period = 0;    ///< T, s
    Matrix coefficients;  ///< a row per coordinate, columns h0, hc_1, hs_1, hc_2 ...
    /// Largest entry of the residual, at times between those that were balanced, relative to that of the load: what the
    /// neglected harmonics would have to balance.
    double remainder = 0;
    Matrix state_coefficients = {};  ///< as `coefficients`, of the states beside the coordinates

    int harmonics() const { return static_cast<int>(coefficients.cols() / 2); }
    /// Positions (derivative 0), rates (1) or accelerations (2) of all coordinates.
    Vector at(double time, int derivative = 0) const;
    /// Values of all states beside the coordinates.
    Vector states_at(double time) const;
};

/// Makes the harmonics 0 ... `harmonics` of M(t) q'' + C(t) q' + K(t) q - Q_s(t) s - f(t) vanish, and those of the
/// states' equations: Galerkin's method over the
/// period, with the equations evaluated at `samples` equidistant times (0: 4 (harmonics + 1)). Exact apart from the
/// neglected harmonics. If the system is stable, this is the response that remains when transients have decayed. Cost:
/// one linear system of n (2 harmonics + 1) rows.
/// @throws InputError for a system of first order, no harmonics, or fewer than 2 harmonics + 1 samples; NumericalError
/// if a load is not finite or of the wrong size, or if the equations are singular: undamped resonance
ForcedResponse forced_response(const PeriodicSystem& system, const std::function<Vector(double time)>& load,
                               int harmonics, int samples = 0);

}  // namespace cardan::solvers
