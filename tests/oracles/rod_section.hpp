#pragma once

#include "tests/oracles/cosserat_rod.hpp"

#include <functional>
#include <limits>

namespace cardan::oracles {

/// A section of a rod in its own principal axes: stiffnesses about three centres. Written down from the energy, not
/// from a matrix:
///     N^2 / 2 EA + T_sc^2 / 2 GJ + My_tc^2 / 2 EI_y + Mz_tc^2 / 2 EI_z + Vy^2 / 2 GA_y + Vz^2 / 2 GA_z,
///     T_sc = T + e_z Vy - e_y Vz,  My_tc = My - c_z N,  Mz_tc = Mz + c_y N.
/// Infinite stiffnesses are rigid.
struct RodSection {
    static constexpr double rigid = std::numeric_limits<double>::infinity();
    double mass = 1;                                                                ///< kg/m
    double EA = rigid, GA_y = rigid, GA_z = rigid, GJ = rigid, EI_y = 1, EI_z = 1;  ///< N, N m^2
    Eigen::Vector2d mass_centre = Eigen::Vector2d::Zero();                          ///< (y, z), m
    Eigen::Vector2d shear_centre = Eigen::Vector2d::Zero();
    Eigen::Vector2d tension_centre = Eigen::Vector2d::Zero();
    double j_y = 0, j_z = 0;  ///< inertia per length about y and z through the mass centre, kg m

    RodVector6 strain(const RodVector6& forces) const;
    RodInertia inertia() const;
};

/// A twisted rod: its axes are the principal ones, turned by beta(s) about +x from those of the line.
struct TwistedRod {
    double length = 1;
    std::function<RodSection(double s)> section = {};
    double beta_root = 0, beta_rate = 0;                      ///< beta = root + rate s, rad, rad/m
    Eigen::Vector2d curvature = Eigen::Vector2d::Zero();      ///< of the line about its y and z (untwisted), 1/m
    Eigen::Vector3d root_position = Eigen::Vector3d::Zero();  ///< m
    Eigen::Matrix3d root_rotation = Eigen::Matrix3d::Identity();
    int steps = 64;

    double beta(double s) const { return beta_root + beta_rate * s; }
    /// Turn by beta about x: principal axes -> axes of the line.
    Eigen::Matrix3d principal(double s) const;
    CosseratRod rod() const;
    /// Likewise in the axes of the line, which do not turn with the twist.
    CosseratRod rod_in_line_axes() const;
};

}  // namespace cardan::oracles
