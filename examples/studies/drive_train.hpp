/// @file
/// Modes of a turning machine in multi-blade coordinates, and the torsion of its drive train among them.
#pragma once

#include "mbs/base/error.hpp"
#include "solvers/linear/coleman.hpp"
#include "solvers/linear/modes.hpp"
#include "turbines/model/assembly.hpp"

#include <numeric>
#include <vector>

namespace cardan::program {

/// System of all coordinates, the spin among them, linearised about a steady rotation.
inline solvers::SecondOrderSystem multi_blade_system(const turbines::Turbine& turbine, const DynamicState& at) {
    const int spin = turbine.rotor().spin;
    std::vector<int> all(static_cast<std::size_t>(turbine.system().model.size()));
    std::iota(all.begin(), all.end(), 0);
    const solvers::Linearisation lin = solvers::linearise(turbine.system(), at);
    const solvers::ColemanTransform coleman(turbine.rotor(), all, lin.states);
    return coleman.transform(solvers::restrict_to(lin, all, spin), at.q(spin), at.qd(spin));
}

/// Mode of the drive train: among those up to a frequency the one with the largest part of its elastic energy in the
/// main shaft.
/// @param system  over all coordinates, and its modes
/// @throws NumericalError if there is none
inline solvers::Mode drive_train_mode(const turbines::Turbine& turbine, const solvers::SecondOrderSystem& system,
                                      const std::vector<solvers::Mode>& modes, double max_hz) {
    const int twist = turbine.system().model.coordinates().index("main shaft twist");
    const solvers::Mode* best = nullptr;
    double largest = 0;
    for (const solvers::Mode& mode : modes) {
        if (!mode.oscillates() || mode.natural_hz() > max_hz || mode.is_state_motion()) continue;
        const double share = solvers::energy_by_row(system, mode)(twist);
        if (share > largest) largest = share, best = &mode;
    }
    if (best == nullptr) throw NumericalError(text("no mode up to ", max_hz, " Hz twists the main shaft"));
    return *best;
}

}  // namespace cardan::program
