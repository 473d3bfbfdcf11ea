// Spinning beams with everything off their axis: settings with different signs, for the elements and for the oracle.
#pragma once

#include "tests/elements/cardan_beam/rods.hpp"

namespace cardan::testing {

/// EA so soft that the centrifugal force stretches the beam by a thousandth.
inline oracles::RodSection flat() {
    return {.mass = 20, .EA = 4e5, .GJ = 300, .EI_y = 400, .EI_z = 1500, .j_y = 0.08, .j_z = 0.5};
}

struct SpinningRod {
    static constexpr double length = 2, hub_radius = 0.6;  // m
    double cone, speed;                                    // rad, positive: tip toward the spin axis z; rad/s
    oracles::RodSection section;
    double beta_root, beta_tip;
    Eigen::Vector2d curvature = Eigen::Vector2d::Zero();  // positive about z: tip toward +y, about y: toward -z
    Vec3 load = Vec3::Zero();                             // dead, per length
    double taper = 0;                                     // height and width fall by this share to the tip

    oracles::RodLoad loads() const {
        oracles::RodLoad loads;
        loads.angular_velocity = {0, 0, speed}, loads.distributed = load;
        return loads;
    }
    /// Root axes in those of the hub, for the elements.
    Placement root() const { return Placement::rotation(rot_y(-cone)) * Placement::translation({hub_radius, 0, 0}); }
    oracles::RodSection section_at(double s) const {
        const double k = 1 - taper * s / length, area = k * k, second = area * area;
        oracles::RodSection at = section;
        for (double* x : {&at.mass, &at.EA, &at.GA_y, &at.GA_z}) *x *= area;
        for (double* x : {&at.GJ, &at.EI_y, &at.EI_z, &at.j_y, &at.j_z}) *x *= second;
        for (Eigen::Vector2d* x : {&at.mass_centre, &at.shear_centre, &at.tension_centre}) *x *= k;
        return at;
    }
    // The root axes written out: x outward and up by the cone.
    oracles::TwistedRod rod() const {
        const double c = std::cos(cone), s = std::sin(cone);
        oracles::TwistedRod rod{.length = length,
                                .section = [*this](double at) { return section_at(at); },
                                .beta_root = beta_root,
                                .beta_rate = (beta_tip - beta_root) / length,
                                .curvature = curvature,
                                .root_position = {hub_radius * c, 0, hub_radius * s}};
        rod.root_rotation << c, 0, -s, 0, 1, 0, s, 0, c;
        return rod;
    }
};

/// Mass centre behind the line and above it, twist falling, coned toward the spin axis.
inline SpinningRod aft() {
    oracles::RodSection s = flat();
    s.mass_centre = {-0.12, 0.03}, s.tension_centre = {-0.05, 0.02};
    return {.cone = 0.15, .speed = 3, .section = s, .beta_root = -0.4, .beta_tip = 0.3};
}
/// Everything the other way round, and faster.
inline SpinningRod fore() {
    oracles::RodSection s = flat();
    s.mass_centre = {0.1, -0.04}, s.tension_centre = {0.04, -0.03};
    return {.cone = -0.12, .speed = 4, .section = s, .beta_root = 0.5, .beta_tip = -0.1};
}

}  // namespace cardan::testing
