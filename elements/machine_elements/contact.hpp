/// @file
/// Contact by the law of Hunt and Crossley.
#pragma once

#include "mbs/system/forces.hpp"

namespace cardan {

/// F = stiffness d^exponent (1 + dissipation dd/dt) at a depth d > 0, never pulling. The force rises from zero with the
/// depth, unlike that of a spring with a damper, and the losses grow with the speed of impact v as those of metals do:
/// the coefficient of restitution e depends on a v alone, a v (1 + e) = ln((1 + a v)/(1 - a e v)).
///                                                                                          [Hunt and Crossley 1975]
struct HuntCrossley {
    double stiffness = 0;    ///< N/m^exponent (N m/rad^exponent), > 0
    double exponent = 1.5;   ///< >= 1; 3/2: Hertz' law of spheres
    double dissipation = 0;  ///< a, s/m (s/rad), >= 0

    struct Force {
        double force = 0, by_depth = 0, by_speed = 0, energy = 0;  ///< energy: of the elastic part
    };
    /// @param depth, speed  d and dd/dt
    Force at(double depth, double speed) const;
    /// @throws InputError for values out of range
    void check(const std::string& where) const;
};

/// The origin of a frame on the plane x, y of another, from which the side of positive z is free.
struct PlaneContact {
    std::string name = {};
    FrameId plane = {}, point = {};
    HuntCrossley law = {};
};
void add_plane_contact(ForceSet& forces, const PlaneContact& contact);

/// A stop of a coordinate by the same law.
/// @param upper  acts above the limit; else below
ForceElement contact_stop(std::string name, BodyId coordinate, double limit, bool upper, const HuntCrossley& law);

}  // namespace cardan
