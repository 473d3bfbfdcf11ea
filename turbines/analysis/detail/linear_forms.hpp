/// @file
/// Constant forms of a linear model. Internal to the room.
#pragma once

#include "turbines/analysis/linear_model.hpp"

namespace cardan::turbines {

/// Fills in `form` and all constant models.
/// @param description  of the machine
void add_constant_forms(MachineLinearModel& linear, const TurbineDescription& description);

}  // namespace cardan::turbines
