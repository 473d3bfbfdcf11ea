#pragma once

#include <Eigen/Core>

#include <functional>

namespace cardan::oracles {

/// A straight Euler-Bernoulli beam along x in [0, L] that bends in one plane; any consistent set of units.
struct StraightBeam {
    enum class Plane { flap, lag };                   ///< out of the plane of rotation, in it
    enum class Root { clamped, hinged, free };        ///< at x = 0; x = L is free
    Eigen::VectorXd breaks;                           ///< 0 = x_0 < ... < x_n = L; EI and mu are smooth in between
    std::function<double(double)> bending_stiffness;  ///< EI(x), N m^2
    std::function<double(double)> mass_per_length;    ///< mu(x), kg/m, a line of mass: no rotary inertia
    double rotor_speed = 0.0;                         ///< Omega, rad/s, about an axis perpendicular to x
    double hub_radius = 0.0;                          ///< distance of x = 0 from that axis, m
    Plane plane = Plane::flap;
    Root root = Root::clamped;
};

/// Rayleigh-Ritz solution with the SLOPE theta = w' as unknown (p-version basis, continuous) and w = int theta dx:
///     U = 1/2 int (EI theta'^2 + T theta^2) dx - [lag] Omega^2/2 int mu w^2 dx,   T(x) = Omega^2 int_x^L mu (R+s) ds
///     T_kin = 1/2 int mu w'^2 dx (w' the velocity).
/// The beam is inextensible; T theta^2/2 is the work of the centrifugal force on the foreshortening. Frequencies are
/// upper bounds and converge exponentially with the degree.
/// [Meirovitch, Analytical Methods in Vibrations, 1967, sections 6-4 and 10-4; Wright et al., J. Appl. Mech. 49 (1982)]
class StraightBeamRitz {
public:
    explicit StraightBeamRitz(const StraightBeam& beam, int degree = 20);

    /// The first `count` natural frequencies, rad/s, rising; rigid-body modes come as (numerical) zeros.
    Eigen::VectorXd frequencies(int count) const;

    /// Least dead axial compression at x = L at which the straight beam (at rest, clamped) buckles, N.
    double critical_tip_load() const;

private:
    Eigen::MatrixXd mass_;
    Eigen::MatrixXd stiffness_;  // elastic + centrifugal
    Eigen::MatrixXd foreshortening_;
    double shift_;
};

}  // namespace cardan::oracles
