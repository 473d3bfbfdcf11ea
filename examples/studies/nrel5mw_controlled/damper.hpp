/// @file
/// A damper of the drive train by the torque of the generator.
#pragma once

#include "examples/studies/nrel5mw_controlled/machine.hpp"

#include <string>

namespace cardan::controlled {

struct DamperStudy {
    double wind = 15;                  ///< m/s
    double gain = 1500, width = 0.5;   ///< of the damper: N m s/rad; damping ratio of its band pass
    double change = 1, duration = 12;  ///< of the wind, m/s; s
};

/// Prints the mode of the drive train without and with it; writes PREFIX.svg and .png: the twist of the main shaft
/// after a step of the torque.
/// @return exit code: 3, it does not damp
int damper(const MachineOptions& machine, const DamperStudy& options, const std::string& out);

}  // namespace cardan::controlled
