/// @file
/// Contact by the law of Hunt and Crossley, and dry friction with Stribeck's curve.
#pragma once

#include "mbs/system/dry_friction.hpp"
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

/// Friction T(v) against sliding at the speed v: static friction falls with the speed to Coulomb's, and a viscous part
/// rises,
///
///     T = (Fc + (Fs - Fc) exp(-|v|/vs)) tanh(v/vr) + c v .
///
/// tanh takes the place of the jump at v = 0: what should stick creeps, at a speed of the order of vr. So make vr small
/// beside the speeds that matter; steps of integration shorten as vr does.             [Armstrong-Helouvry et al. 1994]
struct StribeckFriction {
    double static_force = 0;       ///< Fs, N or N m, >= Fc
    double coulomb_force = 0;      ///< Fc, >= 0
    double stribeck_speed = 0;     ///< vs, m/s or rad/s, >= 0; 0: from Fs to Fc at once, where it truly sticks
    double viscous = 0;            ///< c, N s/m or N m s/rad, >= 0
    double regularisation = 1e-4;  ///< vr, m/s or rad/s, > 0; where it truly sticks, a millionth of it is standstill

    struct Force {
        double force = 0, by_speed = 0;
    };
    Force at(double speed) const;
    /// Force without regularisation, while it slides one way: T on and beyond v = 0.
    /// @param direction  1: v > 0, -1: v < 0
    Force sliding(double speed, int direction) const;
    void check(const std::string& where) const;
};

/// Adds friction on a coordinate, against its rate as seen from a surface that moves along it.
/// @param surface_speed  of the surface, m/s or rad/s
ForceElement friction_force(std::string name, BodyId coordinate, const StribeckFriction& law, double surface_speed = 0);

/// Adds friction with true sticking where a time integration watches for it (stick_slip()): adds the force of sliding,
/// and the lock that holds what sticks. Elsewhere - steady states, linear models - the law is regularised.
DryFriction add_dry_friction(ForceSet& forces, LoopSet& loops, const std::string& name, BodyId coordinate,
                             const StribeckFriction& law, double surface_speed = 0);

}  // namespace cardan
