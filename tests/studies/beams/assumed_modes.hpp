/// @file
/// Uniform beams by assumed modes.
#pragma once

#include "examples/studies/beams/assumed_modes_blade.hpp"
#include "mbs/base/entry.hpp"

namespace cardan::testing {

/// L = m = EI = 1; mass on a line.
inline EngineeringSection slender() {
    EngineeringSection s;
    s.mass = s.EI_flap = s.EI_edge = 1;
    return s;
}

inline AssumedModesBasis one_piece(int bending, int torsion = 0, int extension = 0) {
    return {.breaks = {0, 1}, .bending = bending, .torsion = torsion, .extension = extension};
}

inline HubMotion spinning(double speed, double hub_radius = 0) {
    return HubMotion{.A = {0, 0, speed}}.moved({hub_radius, 0, 0});
}

/// Angular frequencies of the modes of one kind, rising.
inline std::vector<double> of_kind(const AssumedModesBlade& blade, const HubMotion& motion, Deflection kind) {
    const AssumedModesMatrices matrices = blade.at(motion);
    std::vector<double> found;
    for (const AssumedMode& mode : natural_modes(matrices))
        if (entry(energy_shares(blade, matrices, mode.shape), kind) > 0.5) found.push_back(2 * pi * mode.hz);
    return found;
}

}  // namespace cardan::testing
