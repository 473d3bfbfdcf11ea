/// @file
/// An assumed-modes model of the NREL 5 MW blade, clamped to a hub with prescribed motion: an independent check of the
/// joint chain of turbines/reference_turbines/nrel5mw_blade.hpp, and the model of a 2018 paper
/// (docs/nrel5mw_paper2018.md).
#pragma once

#include "examples/studies/beams/assumed_modes_blade.hpp"
#include "mbs/base/units.hpp"
#include "turbines/reference_turbines/nrel5mw_blade.hpp"

namespace cardan::turbines {

/// The model as in the paper: twist, mass centres off the axis, five polynomials for each deflection and three sines
/// for torsion over the whole length, inextensible, no rotary inertia in bending. Two choices are inferred because they
/// reproduce its frequencies: mass times 1.04536 and polynomials from (x/L)^2 on (NP = 2).
/// @param tension  wrong_end reproduces its frequencies in rotation, which are wrong
AssumedModesBlade nrel5mw_blade_of_2018(TensionIntegral tension = TensionIntegral::from_free_tip,
                                        const BeamLine& line = nrel5mw_blade().line);
/// The paper's model with other basis functions.
/// @throws InputError, see AssumedModesBlade
AssumedModesBlade nrel5mw_blade_of_2018(const AssumedModesBasis& basis, TensionIntegral tension,
                                        const BeamLine& line = nrel5mw_blade().line);

/// The NREL 5 MW blade with a convergent basis, cubics for v and w and quadratics for torsion and extension between all
/// stations, with rotary inertia: 384 coordinates.
AssumedModesBlade nrel5mw_blade_converged(const BeamLine& line = nrel5mw_blade().line);

/// Steady rotation of the isolated blade: axes of the hub with x along the blade, z along the rotor axis.
/// @param rotor_speed  rad/s
HubMotion nrel5mw_spinning_hub(double rotor_speed);

/// Motion of the machine of turbines/reference_turbines/nrel5mw_platform.hpp, with the signs given there.
struct Nrel5mwMotion {
    PrescribedCoordinate surge, sway, heave;    ///< downwind; to the right seen along the wind; up
    PrescribedCoordinate roll, pitch, yaw;      ///< pitch positive: the top of the tower moves upwind
    PrescribedCoordinate nacelle_yaw, azimuth;  ///< blade up at azimuth 0
};
/// Motion of the blade root, axes e1 (along the blade), e2 (to the leading edge), e3 (downwind).
/// @param gravity  m/s^2, downward
HubMotion nrel5mw_blade_root(const Nrel5mwMotion& motion, double gravity = units::standard_gravity);

}  // namespace cardan::turbines
