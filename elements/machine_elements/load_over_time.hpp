/// @file
/// Loads at a frame that are given as a table over time: thrust of a gust, pull of a crane, an earthquake's forces.
///
///     forces.add_wrench(force_over_time("gust", shaft, {0, 2, 5}, {Vec3(0, 0, 0), Vec3(4e5, 0, 0), Vec3(0, 0, 0)}));
///
/// is all that is needed: channels of loads take them into account as they do any wrench of the force set.
#pragma once

#include "mbs/system/forces.hpp"

#include <string>
#include <vector>

namespace cardan {

/// Force (N) and moment (N m) at the origin of a frame, linear between the rows. Before the first row the load is that
/// of the first, after the last row that of the last, so that it never jumps: a load that begins or ends with nothing
/// has rows of zero there, one that is applied at once two rows close to one another. Where the slope changes the
/// integrator ends a step and restarts (FrameLoad::breaks); rows between which nothing changes cost nothing. Evaluation
/// takes a binary search and allocates nothing.
/// @param times  of the rows, s, at least two, strictly increasing
/// @param rows   as many
/// @param axes   base: dead load, components in ground axes; frame: follower load, components in those of the frame
///
/// @throws InputError naming the load and the row: too few rows, not as many as times, times that do not increase,
/// numbers that are not finite
FrameLoad load_over_time(std::string name, FrameId frame, std::vector<double> times, std::vector<Wrench> rows,
                         WrenchAxes axes = WrenchAxes::base);

/// A force over time, without a moment, N.
FrameLoad force_over_time(std::string name, FrameId frame, std::vector<double> times, const std::vector<Vec3>& forces,
                          WrenchAxes axes = WrenchAxes::base);

}  // namespace cardan
