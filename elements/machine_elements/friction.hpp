/// @file
/// Dry friction with Stribeck's curve.
#pragma once

#include "mbs/system/dry_friction.hpp"
#include "mbs/system/forces.hpp"

namespace cardan {

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
    /// Force of sliding one way, without regularisation: T on and beyond v = 0.
    /// @param direction  1: v > 0, -1: v < 0
    Force sliding(double speed, int direction) const;
    void check(const std::string& where) const;
};

/// On a coordinate, against its rate as seen from a surface that moves along it.
/// @param surface_speed  of the surface, m/s or rad/s
ForceElement friction_force(std::string name, BodyId coordinate, const StribeckFriction& law, double surface_speed = 0);

/// Adds friction with true sticking where a time integration watches for it (stick_slip()): the force of sliding, and
/// the lock that holds what sticks. Elsewhere - steady states, linear models - the law is regularised.
DryFriction add_dry_friction(ForceSet& forces, LoopSet& loops, const std::string& name, BodyId coordinate,
                             const StribeckFriction& law, double surface_speed = 0);

}  // namespace cardan
