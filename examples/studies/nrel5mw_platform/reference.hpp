/// @file
/// The response beside the reference, on a terminal.
#pragma once

#include "examples/studies/machines/nrel5mw_platform_reference.hpp"
#include "solvers/time/recorder.hpp"

namespace cardan::platform {

/// Prints mean, extremes and harmonics of the signals and, if there is one, the reference with the errors.
/// @return largest error over what is allowed for it (see docs/nrel5mw_platform.md); 0 without a reference
double print_signals(const solvers::History& period, int count, const ReferenceCase* reference);

}  // namespace cardan::platform
