/// @file
/// Dry friction by events: when it sticks and when it breaks loose.
#pragma once

#include "mbs/system/dry_friction.hpp"
#include "solvers/time/integrate.hpp"

namespace cardan::solvers {

/// Events for the integration of a system with dry friction (add_dry_friction()). What slides sticks as soon as it
/// stands still on its surface and the force that this takes is no more than the static friction; what sticks breaks
/// loose where it would take more. So friction is exact: nothing creeps, and steps are as long as the motion allows.
///
/// In a loop a coordinate may stand still for a moment because the mechanism makes it so, as the piston of a running
/// engine does at a dead centre, or because a drive does: loops alone determine it there, no force holds it, and its
/// friction changes direction. Where several contacts could hold the same motion at rest each carries a share of the
/// load, until it breaks loose.
///
/// The states of the frictions are set for the start of the integration: whoever integrates the same system twice calls
/// this twice, and one integration runs at a time.
/// @param drives, time, q, qd  as for the Integrator
/// @throws InputError for a friction that is not one of the system's
std::vector<Event> stick_slip(const System& system, std::vector<DryFriction> frictions,
                              const std::vector<Drive>& drives, double time, const Vector& q, const Vector& qd);

}  // namespace cardan::solvers
