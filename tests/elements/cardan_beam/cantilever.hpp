// A uniform or tapered beam modelled by cardanic elements, all the way to its frequencies.
#pragma once

#include "elements/cardan_beam/single_beam.hpp"
#include "mbs/base/entry.hpp"
#include "solvers/equilibrium/natural_modes.hpp"

#include <cmath>

namespace cardan::testing {

inline constexpr double sixth = 1. / 6;

/// A slender section: no polar inertia, so torsion must be locked.
inline EngineeringSection slender(double EI, double mass) {
    EngineeringSection s;
    s.mass = mass;
    s.EI_flap = s.EI_edge = EI;
    return s;
}

inline CardanBeamOptions bending_only(int elements, double delta = delta_gauss,
                                      Partition partition = Partition::segment_masses) {
    CardanBeamOptions options;
    options.elements = elements;
    options.delta = delta;
    options.partition = partition;
    options.torsion = false;
    return options;
}

/// Extension and torsion free.
inline CardanBeamOptions all_free(int elements, double delta = delta_gauss) {
    CardanBeamOptions options;
    options.elements = elements;
    options.delta = delta;
    options.extension = true;
    return options;
}

/// Observed order of convergence from one number of elements to twice as many.
inline double order(double coarse, double fine, double exact = 0) {
    return std::log2(std::abs(coarse - exact) / std::abs(fine - exact));
}

/// Angular frequencies of a clamped beam (both planes), ascending.
inline std::vector<double> clamped_frequencies(const BeamLine& line, const CardanBeamOptions& options) {
    const SingleBeam beam = clamped_beam(line, options);
    std::vector<double> omega;
    for (const solvers::Mode& mode : solvers::natural_modes(beam.system).modes)
        omega.push_back(std::abs(mode.eigenvalue));
    return omega;
}

/// Bending frequency number `mode` (from 1) of a beam whose two planes are alike: each comes twice.
inline double bending(const std::vector<double>& omega, int mode) {
    return entry(omega, 2 * (mode - 1));
}

}  // namespace cardan::testing
