/// @file
/// Shapes of modes as motions of frames, for pictures.
#pragma once

#include "solvers/campbell/diagram.hpp"
#include "solvers/campbell/point.hpp"

#include <vector>

namespace cardan::solvers {

/// Frames on the lines of the machine, then those of all bodies; each once. Their names, positions and the lines,
/// renumbered to count in this list, go to the diagram.
std::vector<FrameId> recorded_frames(const System& system, const RotorMap& rotor, Campbell& diagram);

/// Motions of frames in some modes of a point, at azimuth 0: shapes times frame Jacobians.
/// @return  [mode of the point][frame]; empty for other modes
std::vector<std::vector<FrameMotion>> motions(const System& system, const PointSolver& solver,
                                              const CampbellPoint& point, const std::vector<int>& modes,
                                              const std::vector<FrameId>& frames);

}  // namespace cardan::solvers
