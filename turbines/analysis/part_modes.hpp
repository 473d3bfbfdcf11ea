/// @file
/// Modes of the parts of a machine by themselves: what there is to see of one whose source lacks masses.
///
///     const turbines::Machine machine = turbines::read_machine("MODEL.yaml");
///     if (!machine.description.missing.empty()) std::cout << solvers::table(*turbines::part_modes(machine).blade);
#pragma once

#include "solvers/campbell/diagram.hpp"
#include "turbines/analysis/settings.hpp"
#include "turbines/machine/machine.hpp"

#include <optional>
#include <vector>

namespace cardan::turbines {

struct PartModesSettings {
    /// Rotor speeds for the blade, rising, rad/s; empty: standstill and, if the machine names one, its speed.
    std::vector<double> rotor_speeds = {};
    MachineSettings machine = {};
    /// Highest, Hz; none: for each part 1.3 times its third frequency at rest.
    std::optional<double> max_frequency_hz = std::nullopt;
};

/// Modes of a clamped part without gravity. Empty: the machine lacks what the part needs, or it does not bend.
struct PartModes {
    std::optional<solvers::Campbell> blade;  ///< the first one, clamped at its root to a rigid hub
    std::optional<solvers::Campbell> tower;  ///< at rest, clamped at its foot, without what it carries
};
/// @throws InputError for settings out of range
PartModes part_modes(const Machine& source, const PartModesSettings& settings = {});

}  // namespace cardan::turbines
