/// @file
/// Controller of the NREL 5 MW machine.
#pragma once

#include "elements/controllers/variable_speed_controller.hpp"

namespace cardan::turbines {

/// The baseline controller of the machine's report.
///                    [J. Jonkman, S. Butterfield, W. Musial, G. Scott 2009, NREL/TP-500-38060, section 7]
VariableSpeedParameters nrel5mw_controller();

}  // namespace cardan::turbines
