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
    double standstill = 0;   ///< azimuth of the rotor if it does not turn, rad; the only azimuth used then
};

/// M z'' + C z' + K z = 0 in multi-blade coordinates, averaged over a revolution; the spin is prescribed.
struct AzimuthAverage {
    SecondOrderSystem system;
    std::vector<MultiBladeRow> rows;
    /// Part that averaging neglects: largest deviation of K, of M and of the states' matrices at an azimuth, each
    /// relative to the norm of the mean.
    double remainder = 0;
    double steady_remainder = 0;  ///< see PeriodicSteadyState::remainder
};

/// Averages the linearised equations over the azimuth. With gravity (or an unbalance) the steady state is periodic with
/// the revolution, and so are the multi-blade matrices. Their mean has the frequencies that OpenFAST's linearisation
/// reports; Floquet theory shows how good that approximation is. The steady state is found by harmonic balance; at
/// standstill it is the equilibrium. Cost: one harmonic balance and O(azimuths n^2). CampbellMethod::averaged takes the
/// same mean along a diagram.
/// @throws InputError for fewer than three azimuths in rotation, and as harmonic_balance() and ColemanTransform;
/// NumericalError where no steady state is found
AzimuthAverage azimuth_average(const System& system, const RotorMap& rotor, const AzimuthAverageOptions& options);

/// The mode of `modes` closest to a given one, by the MAC in the energy product of `system`.
struct NearestMode {
    std::size_t index = 0;
    double mac = 0;
};
/// @throws InputError if there are no modes
NearestMode nearest_mode(const SecondOrderSystem& system, const std::vector<Mode>& modes, const Mode& mode);

}  // namespace cardan::solvers
