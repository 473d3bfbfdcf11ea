#include "solvers/periodic/detail/harmonic_samples.hpp"

#include "mbs/base/entry.hpp"
#include "solvers/algebra/azimuth_series.hpp"

#include <cmath>

namespace cardan::solvers {

HarmonicSamples::HarmonicSamples(int harmonics_kept, int count, double rotor_speed) : harmonics(harmonics_kept) {
    const int columns = 2 * harmonics + 1;
    for (Matrix& one : basis) one.resize(columns, count);
    weights.resize(columns, count);
    for (int s = 0; s < count; ++s) {
        const double psi = azimuths.emplace_back(2 * pi * s / count);
        for (int d = 0; d < 3; ++d)
            entry(basis, d).col(s) = std::pow(rotor_speed, d) * fourier_basis(psi, harmonics, d);
        weights.col(s) = fourier_weights(psi, harmonics, count);
    }
}

}  // namespace cardan::solvers
