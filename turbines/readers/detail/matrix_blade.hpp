/// @file
/// Blades given by 6 x 6 matrices in BeamDyn's axes, as in BeamDyn and windIO.
#pragma once

#include "elements/sections/beam_line.hpp"

namespace cardan::turbines {

/// Axes of BeamDyn: x downwind, y to the trailing edge, z along the blade.
struct MatrixBlade {
    std::vector<Vec3> points;               ///< of the reference line from (0, 0, 0), z increasing, m
    std::vector<double> twist_at;           ///< fractions of the length along the line; empty: at the points
    std::vector<double> twist;              ///< leading edge upwind, rad; linear in between
    std::vector<double> eta;                ///< fractions of the length, 0 ... 1
    std::vector<SectionMatrices> matrices;  ///< one per eta, in the twisted axes of the section; linear in between
};

/// The blade in beam axes: the line is a spline through the points (pieces through two or three; straight if all lie on
/// z), stations wherever matrices or twist are given. BeamDyn's section axes have, without twist, their first axis
/// without component along the y axis of the root, the carried axes of a ReferenceLine do not turn about the tangent;
/// the angle between them is part of the table's beta.
/// @throws InputError
BeamTable matrix_blade_table(const std::string& name, const MatrixBlade& blade);

/// Linear interpolation between increasing positions; constant beyond the ends.
double interpolated(const std::vector<double>& places, const std::vector<double>& values, double at);

}  // namespace cardan::turbines
