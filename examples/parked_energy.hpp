/// @file
/// The theorem of energy for a machine that does not turn: there may be no kinetic energy to measure its error by.
#pragma once

#include "examples/simulation.hpp"

namespace cardan::program {

/// The most that kinetic energy, potential energy or the work of the drives range over in a run, J; at least 1 J, for
/// a machine at rest exchanges nothing.
inline double exchanged_energy(const solvers::History& history) {
    double most = 1;
    for (const char* name : {"kinetic energy", "potential energy", "energy from drives"}) {
        const auto [low, high] = std::ranges::minmax(history[name]);
        most = std::max(most, high - low);
    }
    return most;
}

/// As check_energy(), with another measure.
/// @param exchanged  exchanged_energy() of the whole run, J
/// @param allowed    part of it that may be lost or won
inline bool check_exchanged_energy(const solvers::EnergyBalance& end, double exchanged, double allowed) {
    std::printf(
        "energy, kJ: kinetic %.3f, potential %.3f, dissipated %.3f, by drives %.3f, by loads %.3f, error %.2e\n",
        end.kinetic / 1e3, end.potential / 1e3, end.dissipated / 1e3, end.drives / 1e3, end.loads / 1e3,
        end.error / 1e3);
    return check("energy lost by the integration, of the most that is exchanged", end.error / exchanged, allowed);
}

}  // namespace cardan::program
