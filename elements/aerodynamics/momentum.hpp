/// @file
/// Blade-element momentum: induction of an annulus.
#pragma once

#include "elements/aerodynamics/polar.hpp"

#include <span>

namespace cardan {

/// Effects that the balance of momentum takes into account.
struct MomentumOptions {
    bool tip_loss = true, hub_loss = true;  ///< Prandtl
    bool axial_drag = true;                 ///< drag in the axial balance
    bool rotation = true;                   ///< a' of the wake
    bool tangential_drag = true;            ///< drag in that of the rotation
};

/// Kinematic, of the air at 15 C at sea level, m^2/s [ISO 2533:1975, standard atmosphere].
inline constexpr double standard_viscosity = 1.4607e-5;

/// A ring of the rotor and the sections of the blades in it. Axes of a section: x normal to the coned surface,
/// downwind; z along the blade to its tip; y against the motion.
struct Annulus {
    double blades = 3;
    double radius = 0;  ///< from the shaft's axis, m
    double chord = 0;   ///< m
    double angle = 0;   ///< twist and pitch, rad, positive towards feather
    /// Exponents of Prandtl's losses times |sin phi|: (B/2) (R - z) / z and (B/2) (z - z_h) / z_h, z along the blade, R
    /// its tip, z_h its root.
    double tip = 1e300, hub = 1e300;
    const Polar* polar = nullptr;
    double viscosity = standard_viscosity;  ///< kinematic, of the air, m^2/s: for polars at several Reynolds numbers
};

/// Induction of a section, with V_x and V_y the velocity of the air relative to it without induction: u_x = V_x (1 -
/// a), u_y = V_y (1 + a'), phi = atan2(u_x, u_y), angle of attack phi - angle.
struct Induction {
    double axial = 0, tangential = 0;  ///< a, a'
    double phi = 0;                    ///< rad
    /// Root of the balance, rad, in the mirror image with positive V_x and V_y: there it is phi unless a or a' was
    /// limited, or changed later.
    double root = 0;
    bool solved = false;  ///< false: no solution, or nothing to solve; see solve_induction()
};

/// The residual in the single unknown phi [Ning 2014], with Buhl's relation [2005] at high thrust and the branch of a
/// propeller that brakes: solutions are bracketed, so that there is none that is not found. It is looked for between 0
/// and pi, then in the propeller's branch. Where several lie in one bracket, as where the lift falls behind the stall,
/// it is the one of the smallest angle of attack, which is that of attached flow; as the inflow changes, it may come to
/// an end there (a fold), and the loads of the section jump to those of another one.
///
/// Air from behind and a rotor that turns backwards have the solution of the mirror image.
///
/// The Reynolds number within the balance is that of the velocity without induction, that of the forces the one with
/// it, both as in AeroDyn: the balance keeps its single unknown.
///
/// Where F = 0 (root and tip with losses) a = 1, a' = 0. Where no bracket has a solution, a = a' = 0. Both are ratios
/// to the flow through the ring and are faded out, (1 - cos)/2, with it: a' as V_x falls from a 25th of V_y to a 50th,
/// where the drag would take the air round with the rotor, a from a 100th to a 200th. So still air and wind along the
/// disc have a = a' = 0 without a jump, and on the way there nothing drives the rotor.
Induction solve_induction(const Annulus& annulus, double V_x, double V_y, const MomentumOptions& options = {});

/// A section, and the velocity of the air relative to it without induction, m/s.
struct SectionInflow {
    const Annulus* annulus = nullptr;
    double V_x = 0, V_y = 0;
};
/// solve_induction() for each, the same but for rounding, in a third of the time: Newton's method for eight of them
/// side by side, in the usual bracket, 0 ... pi/2. What it does not find there, and sections without a balance, are
/// left to that function. Each search begins from the lift at small angles and does not depend on the other sections.
/// @param out  as many; nothing is allocated
void solve_inductions(std::span<const SectionInflow> sections, const MomentumOptions& options,
                      std::span<Induction> out);

/// Solves for the induction by plain bisection of a thousand parts of each bracket.
Induction solve_induction_plainly(const Annulus& annulus, double V_x, double V_y, const MomentumOptions& options = {});

/// Forces per length, N/m, along x and against y (driving), and the moment about z, N.
struct SectionForce {
    double normal = 0, driving = 0, moment = 0;
    double attack = 0;  ///< rad, -pi ... pi
};
/// @param induction  its phi is that of its a and a'
SectionForce section_force(const Annulus& annulus, double V_x, double V_y, const Induction& induction, double density);

}  // namespace cardan
