/// @file
/// Continues a motion in other coordinates, away from the singularity of a chart.
///
/// Joint coordinates are a chart of the configuration space. Three revolute joints with one centre have a singular
/// metric where their axes lie in one plane; three about other axes are singular elsewhere. So a motion that approaches
/// the singularity of one tree is continued in another tree that carries the same bodies on different joints.
#pragma once

#include "mbs/model/model.hpp"

namespace cardan {

struct ChartState {
    Vector q, qd;  ///< size n
};

/// The state of `from` in the coordinates of `to` (transition map). Coordinates of the same name mean the same in both
/// and are copied. The others, which only `to` has, follow from the poses and twists of frames that have the same name
/// in both: Gauss-Newton iteration for q, starting at `near` and then at quarter turns, and one linear system for qd.
/// Angles are determined up to whole turns; the value nearest to the starting point is returned.
///
/// Inertias and forces are not compared: it is up to the caller that both trees carry the same bodies at these frames.
/// Allocates.
///
/// @param frames  names, e.g. that of the floating body
/// @param near    size n of `to`: starting point; empty: zero
/// @throws InputError: wrong sizes, no such frame, too few frames for the number of new coordinates
/// @throws NumericalError: no position of the new coordinates carries the frames to these poses; or they are singular
/// there, with the coordinate's name
ChartState change_of_chart(const Model& from, const ChartState& state, const Model& to,
                           const std::vector<std::string>& frames, const Vector& near = {});

/// Distance of the coordinates from being singular for the twist of a frame: smallest singular value of the frame's
/// Jacobian over these coordinates, with columns scaled to unit length. 1: orthogonal; 0: singular. sqrt(1 - |sin(b)|)
/// for three revolute joints with one centre, if the outer axes are perpendicular where the middle joint's angle b is
/// zero. Allocates.
/// @throws InputError for an empty list and for coordinates that do not move the frame
double chart_quality(const Model& model, const Vector& q, std::string_view frame, const std::vector<int>& coordinates);

}  // namespace cardan
