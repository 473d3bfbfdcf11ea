/// @file
/// Elastic connections of two frames: bushings and bearings.
#pragma once

#include "mbs/system/forces.hpp"

#include <vector>

namespace cardan {

/// A spring and a damper in all six directions of frame a, on x = [turns; displacements] of b as seen from a: the sines
/// of the angles about x, y, z of a, which are the angles as long as these are small, and the displacements of the
/// origin along them. f = -K x - D dx/dt; with a rigid frame between its ends, moments are about the origin of b.
struct Bushing {
    std::string name = {};
    FrameId a = {}, b = {};
    Mat6 stiffness = Mat6::Zero();  ///< symmetric; N m/rad, N/rad, N/m
    Mat6 damping = Mat6::Zero();    ///< N m s/rad, N s/rad, N s/m
};
/// @throws InputError: numbers that are not finite, a stiffness that is not symmetric, nothing at all
void add_bushing(ForceSet& forces, const Bushing& bushing);

/// The eight coefficients of a journal bearing, across the axis: f = -stiffness (x, y) - damping (dx/dt, dy/dt). Unlike
/// springs these need not be symmetric: oil films feed forward whirl.
struct BearingCoefficients {
    Eigen::Matrix2d stiffness = Eigen::Matrix2d::Zero();  ///< [kxx kxy; kyx kyy], N/m
    Eigen::Matrix2d damping = Eigen::Matrix2d::Zero();    ///< N s/m
};

/// Coefficients over the speed of the shaft, linear in between.
class JournalBearingTable {
public:
    /// @param speeds  rad/s, ascending, at least one
    /// @throws InputError: not as many coefficients, speeds that do not ascend, numbers that are not finite
    JournalBearingTable(std::vector<double> speeds, std::vector<BearingCoefficients> coefficients);
    /// @throws InputError for a speed beyond the table
    BearingCoefficients at(double speed) const;

private:
    std::vector<double> speeds_;
    std::vector<BearingCoefficients> coefficients_;
};

/// A bearing between frame a, across whose z axis it acts, and the origin of frame b.
struct JournalBearing {
    std::string name = {};
    FrameId a = {}, b = {};
    BearingCoefficients coefficients = {};
};
/// Adds a bearing without a potential, since its forces may have none. @throws InputError for numbers that are not
/// finite
void add_bearing(ForceSet& forces, const JournalBearing& bearing);

}  // namespace cardan
