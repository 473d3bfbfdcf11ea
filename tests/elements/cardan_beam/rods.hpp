// One beam twice: as a line of sections for the elements, and as a Cosserat rod for the oracle.
#pragma once

#include "elements/sections/beam_line.hpp"
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

}  // namespace cardan::testing
