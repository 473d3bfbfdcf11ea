/// @file
/// Modes of a rotor with three and more blades under gravity: multi-blade system averaged over the azimuth.
#pragma once

#include "mbs/model/rotor_map.hpp"
#include "solvers/linear/coleman.hpp"
#include "solvers/linear/modes.hpp"

namespace cardan::solvers {

struct AzimuthAverageOptions {
    double rotor_speed = 0;  ///< rad/s
    int azimuths = 24;       ///< per revolution
    int harmonics = 4;       ///< of the periodic steady state
    double standstill = 0;   ///< where the rotor stands if it does not turn, rad: the one azimuth that is taken then
};

/// M z'' + C z' + K z = 0 in multi-blade coordinates, the mean over a revolution; the spin is prescribed.
struct AzimuthAverage {
    SecondOrderSystem system;
    std::vector<MultiBladeRow> rows;
    /// What the mean leaves out: largest deviation of K and of M at an azimuth, each relative to the norm of the mean.
    double remainder = 0;
    double steady_remainder = 0;  ///< see PeriodicSteadyState::remainder
};

/// With gravity (or an unbalance) the steady state repeats itself with the revolution, and so do the multi-blade
/// matrices. Their mean has the frequencies that OpenFAST's linearisation reports; how good it is, Floquet's theory
/// says. Steady state by harmonic balance, at standstill the equilibrium.
/// Cost: one harmonic balance and O(azimuths n^2).
/// @throws InputError for fewer than three azimuths in rotation, and as harmonic_balance() and ColemanTransform;
/// NumericalError where no steady state is found
AzimuthAverage azimuth_average(const System& system, const RotorMap& rotor, const AzimuthAverageOptions& options);

/// The mode of `modes` that comes nearest to a given one, by the energy MAC in the energy product of `system`.
struct NearestMode {
    std::size_t index = 0;
    double mac = 0;
};
/// @throws InputError if there are no modes
NearestMode nearest_mode(const SecondOrderSystem& system, const std::vector<Mode>& modes, const Mode& mode);

}  // namespace cardan::solvers
