#pragma once

#include "tests/oracles/cosserat_rod.hpp"

#include <cmath>
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

    RodVector6 strain(const RodVector6& forces) const {
        const double N = forces(0), Vy = forces(1), Vz = forces(2);
        const double kx = (forces(3) + shear_centre(1) * Vy - shear_centre(0) * Vz) / GJ;
        const double ky = (forces(4) - tension_centre(1) * N) / EI_y, kz = (forces(5) + tension_centre(0) * N) / EI_z;
        RodVector6 strain;
        strain << N / EA - tension_centre(1) * ky + tension_centre(0) * kz, Vy / GA_y + shear_centre(1) * kx,
            Vz / GA_z - shear_centre(0) * kx, kx, ky, kz;
        return strain;
    }
    RodInertia inertia() const {
        return {mass, {0, mass_centre(0), mass_centre(1)}, Eigen::Vector3d(j_y + j_z, j_y, j_z).asDiagonal()};
    }
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
    Eigen::Matrix3d principal(double s) const {
        const double c = std::cos(beta(s)), d = std::sin(beta(s));
        return (Eigen::Matrix3d() << 1, 0, 0, 0, c, -d, 0, d, c).finished();
    }
    /// Likewise in the axes of the line, which do not turn with the twist.
    CosseratRod rod_in_line_axes() const {
        CosseratRod rod;
        rod.length = length;
        rod.root_position = root_position;
        rod.root_rotation = root_rotation;
        rod.steps = steps;
        const TwistedRod self = *this;
        rod.strain = [self](double s, const RodVector6& forces) {
            const Eigen::Matrix3d turn = self.principal(s);
            RodVector6 in_section, strain;
            in_section << turn.transpose() * forces.head<3>(), turn.transpose() * forces.tail<3>();
            in_section = self.section(s).strain(in_section);
            strain << turn * in_section.head<3>(), turn * in_section.tail<3>();
            return strain;
        };
        rod.inertia = [self](double s) {
            const Eigen::Matrix3d turn = self.principal(s);
            const RodInertia in_section = self.section(s).inertia();
            return RodInertia{in_section.mass, turn * in_section.centre, turn * in_section.J * turn.transpose()};
        };
        if (!curvature.isZero(0))
            rod.initial_curvature = [self](double) { return Eigen::Vector3d(0, self.curvature(0), self.curvature(1)); };
        return rod;
    }
    CosseratRod rod() const {
        CosseratRod rod;
        rod.length = length;
        rod.root_position = root_position;
        rod.root_rotation = root_rotation * principal(0);
        rod.steps = steps;
        const TwistedRod self = *this;
        rod.strain = [self](double s, const RodVector6& forces) { return self.section(s).strain(forces); };
        rod.inertia = [self](double s) { return self.section(s).inertia(); };
        rod.initial_curvature = [self](double s) {
            const Eigen::Vector3d of_line(0, self.curvature(0), self.curvature(1));
            return Eigen::Vector3d(self.beta_rate * Eigen::Vector3d::UnitX() + self.principal(s).transpose() * of_line);
        };
        return rod;
    }
};

}  // namespace cardan::oracles
