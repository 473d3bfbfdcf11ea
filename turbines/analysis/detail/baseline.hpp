/// @file
/// Numbers of the baseline controller. Internal to the room.
#pragma once

#include "turbines/analysis/settings.hpp"
#include "turbines/machines/nrel5mw_controller.hpp"

namespace cardan::turbines {

/// With the period that is asked for.
VariableSpeedParameters baseline_parameters(const Controller& controller);

}  // namespace cardan::turbines
