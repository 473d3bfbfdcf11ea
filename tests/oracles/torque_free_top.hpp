#pragma once

#include <Eigen/Core>

namespace cardan::oracles {

/// Free symmetric top: principal inertias (A, A, C) about the mass centre, no torque. Body axes: z = axis of symmetry.
/// The angular velocity turns about the body axis at the rate (C - A) omega_z / A, and the body axis precesses about
/// the angular momentum H (fixed in space) at the rate |H| / A under a constant angle.
/// [Goldstein, Poole and Safko, Classical Mechanics, section 5.6; Landau and Lifshitz, Mechanics, section 33]
class FreeSymmetricTop {
public:
    /// @param transverse  A, kg m^2, > 0
    /// @param axial       C, kg m^2, > 0
    /// @param omega0      angular velocity at t = 0, body axes, rad/s, not zero
    FreeSymmetricTop(double transverse, double axial, const Eigen::Vector3d& omega0);

    Eigen::Vector3d angular_velocity(double time) const;  ///< body axes, rad/s
    double body_rate() const;                             ///< of omega about the body axis, rad/s (signed)
    double precession_rate() const;                       ///< of the body axis about H, rad/s
    double nutation_angle() const;                        ///< between body axis and H, rad, constant
    double angular_momentum() const;                      ///< |H|, N m s
    double kinetic_energy() const;                        ///< J

    /// Rotation body -> space; the space z axis lies along H, the precession angle is zero at t = 0.
    Eigen::Matrix3d attitude(double time) const;

private:
    double a_;
    double c_;
    double transverse_rate_;
    double axial_rate_;
    double phase_;
};

/// Free asymmetric top, principal inertias I1 < I2 < I3, started where omega2 = 0: the angular velocity in body axes
/// by Jacobi's functions (sn for the middle axis; dn for the axis about which the motion circulates, cn for the other).
/// The attitude has Euler angles z-x-z about the angular momentum H: of theta and phi (spin about axis 3) the
/// components of H in body axes tell the value, the precession is a quadrature of Jacobi's functions, to rounding:
///     H (sin(theta) sin(phi), sin(theta) cos(phi), cos(theta)) = (I1 omega1, I2 omega2, I3 omega3),
///     psi' = H (I1 omega1^2 + I2 omega2^2) / (I1^2 omega1^2 + I2^2 omega2^2).
/// [Landau and Lifshitz, Mechanics, section 37, eq. 37.10, 37.14 and 37.15]
class FreeAsymmetricTop {
public:
    /// @param inertia  (I1, I2, I3), rising, kg m^2
    /// @param omega1   at t = 0 about axis 1, rad/s
    /// @param omega3   at t = 0 about axis 3, rad/s; the separatrix H^2 = 2 T I2 is excluded
    FreeAsymmetricTop(const Eigen::Vector3d& inertia, double omega1, double omega3);

    Eigen::Vector3d angular_velocity(double time) const;  ///< body axes, rad/s
    double period() const;                                ///< of the angular velocity in body axes, s
    double angular_momentum() const;                      ///< H, N m s
    double kinetic_energy() const;                        ///< J
    /// Rotation body -> space; the space z axis lies along H, the precession angle is zero at t = 0. omega1 not zero.
    Eigen::Matrix3d attitude(double time) const;
    bool circulates_about_axis_3() const { return about_3_; }

private:
    Eigen::Vector3d inertia_;
    bool about_3_;
    double k_;
    double rate_;                // d tau / dt, 1/s
    Eigen::Vector3d amplitude_;  // rad/s
};

}  // namespace cardan::oracles
