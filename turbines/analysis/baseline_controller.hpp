/// @file
/// The usual controller of variable speed and pitch for any machine.
#pragma once

#include "elements/controllers/variable_speed_controller.hpp"
#include "turbines/analysis/remark.hpp"
#include "turbines/machine/machine.hpp"

namespace cardan::turbines {

/// Parameters of the baseline controller, each from the first source that has it:
///
/// 1. of the NREL 5 MW machine, by the rated speed of its generator and its gear ratio, those of its report;
/// 2. ControllerGains of the model, as of a ROSCO controller's file: limits, torque and rows of gains;
/// 3. the machine itself. The gains of the pitch are those with which rotor and generator, as one inertia J about the
///    shaft at the rated speed W, oscillate against the air with a damping ratio of 0.7 and a frequency w of 0.4735 W:
///
///        proportional = 2 J W 0.7 w / (N p),   integral = J W w^2 / (N p),   p = -d power / d pitch,
///
///    N the gear ratio, p that of the rotor, not bent, its wake frozen, at rated power in winds above the rated one.
///    The torque below rated speed is that of the largest power coefficient at the pitch below rated power. Filter,
///    rates and the curve around these are those of the NREL 5 MW machine, scaled with rated speed and torque.
///                    [J. Jonkman, S. Butterfield, W. Musial, G. Scott 2009, NREL/TP-500-38060, section 7]
///
/// What was taken from where is reported. The period is left at zero.
/// @param machine  with rated speed and power
/// @throws InputError for a machine without rated speed or power, and without airfoils where the third source is asked
VariableSpeedParameters baseline_controller(const Machine& machine, const Report& report = {});

}  // namespace cardan::turbines
