/// @file
/// Azimuths at which harmonic balance evaluates the equations. Internal to solvers: not installed.
#pragma once

#include "mbs/base/types.hpp"

#include <array>
#include <vector>

namespace cardan::solvers {

/// Equidistant azimuths of a revolution, and what turns series there into motions and residuals back into series.
struct HarmonicSamples {
    HarmonicSamples(int harmonics, int count, double rotor_speed);

    int size() const { return static_cast<int>(azimuths.size()); }

    int harmonics;
    std::vector<double> azimuths;
    std::array<Matrix, 3> basis;  ///< by derivative, times the power of the rotor speed: a column per azimuth
    Matrix weights;               ///< of the projection on the harmonics: a column per azimuth
};

}  // namespace cardan::solvers
