#pragma once

#include <Eigen/Core>

#include <array>
#include <complex>
#include <vector>

namespace cardan::oracles {

/// A rigid two-bladed rotor on a teeter hinge, on a nacelle that yaws about a vertical axis; the shaft is horizontal
/// and turns at a constant rate. The mass centre of the rotor lies on the teeter axis. Small yaw angle y and teeter
/// angle b:
///     L = 1/2 Is (y' cos psi - Omega b)^2 + 1/2 It (b' - y' sin psi)^2 + Ia Omega (y' b cos psi - Omega b^2/2)
///         + 1/2 J y'^2 - 1/2 Ky y^2 - 1/2 Kt b^2,     psi = Omega t, blades vertical at psi = 0.
/// (Angular velocity of the hub along its spanwise, teeter and shaft axes, to second order.)
struct RigidTeeteredRotor {
    double spanwise = 0, teeter = 0, shaft = 0;  ///< Is, It, Ia: about the teeter point, blades included, kg m^2
    double yaw = 0;  ///< J: nacelle about the yaw axis and the rotor's mass at its distance, kg m^2
    double yaw_stiffness = 0, teeter_stiffness = 0;  ///< N m/rad
    double rotor_speed = 0;                          ///< Omega, rad/s

    /// Floquet multipliers of half a revolution, the teeter angle counted anew with the other sign after it (the rotor
    /// looks the same then). By distance from 1, largest first: the teeter pair, then yaw. Classical Runge-Kutta
    /// method.
    std::array<std::complex<double>, 4> half_turn_multipliers(int steps = 2000) const;

    /// x' = A(psi) x, x = (y, b, y', b').
    Eigen::Matrix4d state_matrix(double azimuth) const;
};

/// A uniform blade with rotary inertia on a rigid arm, spinning about an axis perpendicular to it; axially and shear
/// rigid, straight at rest. Rayleigh-Ritz with the slope as unknown (p-version), in one plane:
///     U = 1/2 int (EI theta'^2 + T theta^2) dx + 1/2 T(0) a theta(0)^2 + [flap] Omega^2/2 (Kh theta(0)^2 - j int
///     theta^2)
///         - [lag] Omega^2/2 int mu w^2 dx,   T(x) = Omega^2 mu int_x^L (a + s) ds,  w = a theta(0) + int theta dx
///     T_kin = 1/2 int (mu w'^2 + j theta'^2) dx + 1/2 Jh theta'(0)^2  (here primes of w, theta: rates)
/// theta(0) = 0: clamped; free: the arm turns about a hinge on the rotor axis and carries half of a hub.
struct BladeOnArm {
    double length = 0, mass = 0, stiffness = 0;  ///< m, kg/m, N m^2
    double rotary_inertia = 0;                   ///< j, kg m: turning of the section in the plane
    double arm = 0;                              ///< a, m
    double rotor_speed = 0;                      ///< rad/s
    bool lag = false;                            ///< in the plane of rotation, else out of it
    bool hinged = false;
    double hub_inertia = 0;     ///< Jh: of half of the hub about the hinge, kg m^2 (hinged only)
    double hub_difference = 0;  ///< Kh: about the rotor axis less about the blade axis, half of the hub, kg m^2

    /// The first frequencies, rad/s, rising.
    std::vector<double> frequencies(int count, int degree = 14) const;
};

}  // namespace cardan::oracles
