#pragma once

#include <optional>

namespace cardan::oracles {

/// Heavy symmetric top with a fixed point on its axis (Lagrange's top). Euler angles z-x-z: psi precession about the
/// upward vertical, theta inclination of the axis (0 = upright), phi spin about the axis.
/// [Goldstein, Poole and Safko, Classical Mechanics, section 5.7; Landau and Lifshitz, Mechanics, section 35]
class HeavySymmetricTop {
public:
    /// @param transverse    A about the fixed point, kg m^2, > 0
    /// @param axial         C, kg m^2, > 0
    /// @param weight_moment m g l, N m, > 0; l = distance of the mass centre from the fixed point along the axis
    HeavySymmetricTop(double transverse, double axial, double weight_moment);

    /// Steady precession at inclination theta with omega3 = phi' + psi' cos(theta), the constant spin about the axis:
    ///     A cos(theta) psi'^2 - C omega3 psi' + m g l = 0
    /// Empty if the spin is too slow. At theta = pi/2 only the slow rate exists and `fast` is infinite; below the
    /// horizontal (cos < 0) the two rates have opposite signs.
    struct SteadyPrecession {
        double slow;  ///< rad/s, tends to m g l / (C omega3)
        double fast;  ///< rad/s, tends to C omega3 / (A cos(theta))
    };
    std::optional<SteadyPrecession> steady_precession(double theta, double omega3) const;

    /// Least |omega3| of steady precession at theta, rad/s: 2 sqrt(A m g l cos(theta)) / C; zero below the horizontal.
    /// At theta = 0 it is the limit of stability of the sleeping top.
    double min_spin(double theta) const;

    /// A state; psi and phi are cyclic and do not appear. theta in (0, pi).
    struct State {
        double theta;      ///< rad
        double theta_dot;  ///< rad/s
        double psi_dot;    ///< rad/s
        double omega3;     ///< rad/s, about the axis
    };
    /// What stays constant along any motion.
    struct Conserved {
        double energy;             ///< J, potential zero at the height of the fixed point
        double vertical_momentum;  ///< about the vertical, N m s
        double axial_momentum;     ///< about the axis, N m s
    };
    Conserved conserved(const State& state) const;

    /// Nutation of the motion with the given constants: u = cos(theta) swings between two roots of a cubic,
    ///     u(t) = lower + (upper - lower) sn^2(rate t, modulus),  t = 0 at the lowest position,  period = 2 K / rate.
    struct Nutation {
        double lower;                         ///< least cos(theta)
        double upper;                         ///< greatest cos(theta)
        double rate;                          ///< 1/s
        double modulus;                       ///< k
        double period() const;                ///< s
        double cos_theta(double time) const;  ///< time from the lowest position, s
    };
    Nutation nutation(const State& state) const;

    /// psi' = (vertical - axial cos(theta)) / (A sin^2(theta)), rad/s.
    double precession_rate(const Conserved& constants, double theta) const;

private:
    double a_;
    double c_;
    double mgl_;
};

}  // namespace cardan::oracles
