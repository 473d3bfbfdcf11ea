// One beam twice: as a line of sections for the elements, and as a Cosserat rod for the oracle.
#pragma once

#include "elements/sections/reference_line.hpp"
#include "tests/oracles/rod_section.hpp"

namespace cardan::testing {

inline constexpr double shear_rigid = oracles::RodSection::rigid;

inline EngineeringSection engineering(const oracles::RodSection& rod, double beta = 0) {
    EngineeringSection s;
    s.mass = rod.mass, s.EA = rod.EA, s.GA_y = rod.GA_y, s.GA_z = rod.GA_z;
    s.GJ = rod.GJ, s.EI_flap = rod.EI_y, s.EI_edge = rod.EI_z;
    s.j_flap = rod.j_y, s.j_edge = rod.j_z, s.beta = beta;
    s.mass_centre = {rod.mass_centre(0), rod.mass_centre(1)};
    s.shear_centre = {rod.shear_centre(0), rod.shear_centre(1)};
    s.tension_centre = {rod.tension_centre(0), rod.tension_centre(1)};
    return s;
}

/// Starts along x and turns toward `normal`, a unit vector across x.
inline ReferenceLine arc(double radius, double angle, const Vec3& normal = Vec3::UnitY()) {
    return ReferenceLine::curve(
        [=](double t) { return Vec3(radius * (std::sin(t) * Vec3::UnitX() + (1 - std::cos(t)) * normal)); },
        [=](double t) { return Vec3(radius * (std::cos(t) * Vec3::UnitX() + std::sin(t) * normal)); }, 0, angle);
}

inline BeamLine line_of(const oracles::TwistedRod& rod) {
    BeamLine line{rod.length, {}, {}, "beam"};
    line.section = [rod](double s) { return engineering(rod.section(s), rod.beta(s)).section(); };
    const double k = rod.curvature.norm();
    if (k == 0) return line;
    return along(line, arc(1 / k, k * rod.length, Vec3(0, rod.curvature(1), -rod.curvature(0)) / k));
}

/// What becomes of a chain of cardanic elements of vanishing length. A shear strain tilts the middle body against the
/// terminal ones, which carry the section axes, by a = gamma / (1 - 2 delta); the torsion turns about the tilted axis d
/// and the bending about z about an axis that has followed the tilt about y:
///     1 + Gamma = 2 delta e1 + (1 - 2 delta + eps) d,   d = Ry(ay) Rz(az) e1,
///     kappa = kappa_x d + kappa_y e2 + kappa_z Ry(ay) e3,   ay = -gamma_z / (1 - 2 delta), az = gamma_y / (1 - 2
///     delta).
/// The law is C^-1 g = (dGamma/dg)^T n + (dkappa/dg)^T m over g = (eps, gamma_y, gamma_z, kappa_x, kappa_y, kappa_z).
inline oracles::CosseratRod limit_of_elements(oracles::CosseratRod rod, double delta) {
    const auto law = rod.strain;
    rod.strain = [law, c = 1 / (1 - 2 * delta)](double s, const Vec6& forces) {
        const auto strains = [c](const Vec6& g, Mat6& D) {
            const double ay = -c * g(2), az = c * g(1), cy = std::cos(ay), sy = std::sin(ay);
            const double cz = std::cos(az), sz = std::sin(az);
            const Vec3 d(cy * cz, sz, -sy * cz), d_ay(-sy * cz, 0, -cy * cz), d_az(-cy * sz, cz, sy * sz);
            const Vec3 e3(sy, 0, cy), e3_ay(cy, 0, -sy);
            const double arm = 1 / c + g(0);
            D.setZero();
            D.col(0).head<3>() = d;
            D.col(1).head<3>() = arm * c * d_az;
            D.col(2).head<3>() = -arm * c * d_ay;
            D.col(1).tail<3>() = c * g(3) * d_az;
            D.col(2).tail<3>() = -c * (g(3) * d_ay + g(5) * e3_ay);
            D.col(3).tail<3>() = d;
            D(4, 4) = 1;
            D.col(5).tail<3>() = e3;
            Vec6 strain;
            strain << (1 - 1 / c) * Vec3::UnitX() + arm * d - Vec3::UnitX(),
                g(3) * d + g(4) * Vec3::UnitY() + g(5) * e3;
            return strain;
        };
        Vec6 g = law(s, forces), strain;
        Mat6 D;
        for (int i = 0; i < 40; ++i) {
            strain = strains(g, D);
            const Vec6 next = law(s, Vec6(D.transpose() * forces));
            const double change = (next - g).norm();
            g = next;
            if (change < 1e-16) break;
        }
        return strains(g, D);
    };
    return rod;
}

}  // namespace cardan::testing
