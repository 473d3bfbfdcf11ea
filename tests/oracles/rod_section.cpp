#include "tests/oracles/rod_section.hpp"

#include <cmath>

namespace cardan::oracles {

RodVector6 RodSection::strain(const RodVector6& forces) const {
    const double N = forces(0), Vy = forces(1), Vz = forces(2);
    const double kx = (forces(3) + shear_centre(1) * Vy - shear_centre(0) * Vz) / GJ;
    const double ky = (forces(4) - tension_centre(1) * N) / EI_y, kz = (forces(5) + tension_centre(0) * N) / EI_z;
    RodVector6 out;
    out << N / EA - tension_centre(1) * ky + tension_centre(0) * kz, Vy / GA_y + shear_centre(1) * kx,
        Vz / GA_z - shear_centre(0) * kx, kx, ky, kz;
    return out;
}

RodInertia RodSection::inertia() const {
    return {mass, {0, mass_centre(0), mass_centre(1)}, Eigen::Vector3d(j_y + j_z, j_y, j_z).asDiagonal()};
}

Eigen::Matrix3d TwistedRod::principal(double s) const {
    const double c = std::cos(beta(s)), d = std::sin(beta(s));
    return (Eigen::Matrix3d() << 1, 0, 0, 0, c, -d, 0, d, c).finished();
}

CosseratRod TwistedRod::rod() const {
    CosseratRod rod;
    rod.length = length;
    rod.root_position = root_position;
    rod.root_rotation = root_rotation * principal(0);
    rod.steps = steps;
    rod.strain = [self = *this](double s, const RodVector6& forces) { return self.section(s).strain(forces); };
    rod.inertia = [self = *this](double s) { return self.section(s).inertia(); };
    rod.initial_curvature = [self = *this](double s) {
        const Eigen::Vector3d of_line(0, self.curvature(0), self.curvature(1));
        return Eigen::Vector3d(self.beta_rate * Eigen::Vector3d::UnitX() + self.principal(s).transpose() * of_line);
    };
    return rod;
}

CosseratRod TwistedRod::rod_in_line_axes() const {
    CosseratRod rod;
    rod.length = length;
    rod.root_position = root_position;
    rod.root_rotation = root_rotation;
    rod.steps = steps;
    rod.strain = [self = *this](double s, const RodVector6& forces) {
        const Eigen::Matrix3d turn = self.principal(s);
        RodVector6 in_section, strain;
        in_section << turn.transpose() * forces.head<3>(), turn.transpose() * forces.tail<3>();
        in_section = self.section(s).strain(in_section);
        strain << turn * in_section.head<3>(), turn * in_section.tail<3>();
        return strain;
    };
    rod.inertia = [self = *this](double s) {
        const Eigen::Matrix3d turn = self.principal(s);
        const RodInertia in_section = self.section(s).inertia();
        return RodInertia{in_section.mass, turn * in_section.centre, turn * in_section.J * turn.transpose()};
    };
    if (!curvature.isZero(0))
        rod.initial_curvature = [self = *this](double) {
            return Eigen::Vector3d(0, self.curvature(0), self.curvature(1));
        };
    return rod;
}

}  // namespace cardan::oracles
