/// @file
/// Attached flow of an airfoil from its polar, where nothing else is known of it.
#pragma once

#include "elements/aerodynamics/unsteady_airfoil.hpp"

#include <optional>
#include <vector>

namespace cardan {

/// Data of an attached flow that are known from elsewhere.
struct KnownFlow {
    std::optional<double> slope = {};              ///< of the lift, 1/rad
    std::optional<double> zero_lift = {};          ///< angle of attack without lift, rad
    std::optional<double> upper = {}, lower = {};  ///< ends of the range in which the lift is a line, rad
    std::optional<double> zero_lift_drag = {};     ///< drag coefficient
};

/// Attached flow of the first table of a polar, within 20 degrees of zero, as AeroDyn 5.0 finds what its files leave
/// out [OpenFAST, modules/aerodyn/src/AirfoilInfo.f90; its manual, "Calculating Default Airfoil Coefficients",
/// describes an older way to the slope]: - zero_lift_drag is that of the table. - lower ... upper: slopes of c_n = c_l
/// cos(alpha) + (c_d - zero_lift_drag) sin(alpha) between the points of the table,
///    smoothed over 2 degrees to both sides with the weight (1 - u^2)^3; the range begins at the minimum drag and ends
///    on both sides where the slope falls below nine tenths of its largest value on the way.
///  - slope: that of the line of least squares through the lift in the middle three fifths of the range.
///  - zero_lift: the zero of the table's lift next to that of the line, so that the airfoil at rest has the lift of its
///    table. (AeroDyn takes the zero of the line through c_n; where that is another one, the point of separation
///    jumps next to it.)
///
/// There is no slope, hence no lag, if the lift stays below 0.01 or the drag does not change (cylinders), if the table
/// has fewer than three points there, or if the line does not rise.
///
/// Limits: the lift has to be a line somewhere. Near the root, between a cylinder and an airfoil, it may be one between
/// two points of the table only; such slopes mean little. Five percent of the slope move the point of separation by
/// 0.08 where it is 0.7. Where the lift lies above the line, the airfoil at rest has the line's.
/// @throws nothing; what is known and does not fit is found by UnsteadyAirfoil
AttachedFlow attached_flow(const Polar& polar, const KnownFlow& known = {});

/// Unsteady airfoils of every polar with its attached_flow() and the lags of a thin airfoil:
/// UnsteadyAeroOptions::airfoils.
std::vector<UnsteadyAirfoil> unsteady_airfoils(const std::vector<Polar>& polars);

}  // namespace cardan
