/// @file
/// The motion of a rotor that turns freely, by its speed. Internal to solvers/campbell: not installed.
#pragma once

#include "solvers/linear/modes.hpp"

namespace cardan::solvers {

/// A rotor whose generator holds a torque gains and loses speed against the air: a real root near zero, or, with a wake
/// that lags, one that hardly oscillates. What bends meanwhile follows, and may have as much energy as the rotor, so
/// that energies do not tell what moves. Participation does: with the left vectors y of the coordinates and w of the
/// states, that of coordinate i is
///
///     p_i = [y^H (2 lambda M + C) - w^H f_qd]_i x_i,
///
/// and the sum over all coordinates and states, w^H s, is one. A wake that lags shares in it: many states of either
/// sign, so that coordinates are compared with one another only; whether the mode is one of the states is asked before
/// (Mode::is_state_motion()).
/// @param spin  row of the rotor's rotation; -1: prescribed
/// @return true from `heavy_damping` on if |p_spin| is more than half of the sum of all |p_i|. Cost: that of
/// left_vector(); of other modes none
bool is_motion_of_speed(const SecondOrderSystem& system, const Mode& mode, int spin);

}  // namespace cardan::solvers
