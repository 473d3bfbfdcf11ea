#pragma once

#include "tests/oracles/blade_stations.hpp"
#include "tests/oracles/hierarchical_basis.hpp"

#include <Eigen/Core>

namespace cardan::oracles {

/// One straight, twisted, tapered blade, clamped at the hub radius and spinning at a constant rate about the z axis:
/// small vibrations about its steady deflected state, no gravity, no damping, no air.
///
/// A geometrically exact rod, shear-rigid and inextensible, discretised by Ritz in ANGLES instead of displacements.
/// Section frame R(x) = Rz(c) Ry(b) Rx(phi + beta), beta = -twist; unknown functions phi, b, c vanish at the root.
///     curvatures     kx = phi' - c' sin b,  ky = b' cos f + c' cos b sin f,  kz = -b' sin f + c' cos b cos f,
///                    f = phi + beta, strains in the principal axes of the section
///     elastic energy U = 1/2 int (GJ kx^2 + EI_flap ky^2 + EI_edge kz^2) dx
///     pitch axis     r' = R (e1 + kx (0, ez, -ey)), r(0) = (hub radius, 0, 0): the section turns about its shear
///                    centre (ey, ez); the stationary form of the flexibility with T_sc = T + ez Vy - ey Vz
///     kinetic energy 1/2 int sum_i w_i |x_i' + Omega x x_i|^2 dx over the three vectors mass centre (w = mass), R e2
///                    and R e3 (w = Binet's moments int y'^2, int z'^2 per length about the mass centre).
/// There is no series expansion in the deflections: the Newton iteration for the steady state and the linearisation
/// about it use exact first and second derivatives (jet.hpp), so the tangent is that of the rotating deflected blade.
/// The only approximation is the p-version basis (breaks at the stations), and the Gauss rule that goes with it.
/// [Reissner, ZAMP 32 (1981) 734-744; Hodges, Nonlinear Composite Beam Theory, 2006, chapters 3-5]
class RotatingBlade {
public:
    /// @param blade       sectional properties, SI
    /// @param hub_radius  distance of the root from the rotor axis, m
    /// @param degree      of the polynomials between two stations, at least 1
    RotatingBlade(const BladeStations& blade, double hub_radius, int degree = 5);

    /// About which state the motion is linearised. For `undeflected` the steady state is not solved for; that state is
    /// no equilibrium if the mass centres lie off the pitch axis, so the result depends on the choice of unknowns. It
    /// is offered to show the size of the difference.
    enum class About { deflected, undeflected };

    struct Modes {
        Eigen::VectorXd frequency;   ///< natural frequencies, Hz, rising
        Eigen::Vector3d steady_tip;  ///< displacement of the pitch axis at the tip, m, (x, y, z) as above
        double steady_tip_twist;     ///< elastic phi at the tip, rad
        int newton_steps;
        double residual;  ///< largest generalised force left over, over (centrifugal force times length)
    };
    /// @param rotor_speed  rad/s
    /// @param count        number of modes
    Modes modes(double rotor_speed, int count, About about = About::deflected) const;

    Eigen::Index unknowns() const { return 3 * angle_.cols(); }

private:
    struct Assembly {
        Eigen::MatrixXd mass;
        Eigen::MatrixXd coriolis;
        Eigen::MatrixXd stiffness;
        Eigen::VectorXd residual;
        double load;  // scale of the generalised forces: centrifugal force times length, N m
        Eigen::Vector3d tip;
    };
    Assembly assemble(const Eigen::VectorXd& q, double rotor_speed) const;

    BladeStations blade_;
    double hub_radius_;
    PiecewiseGaussGrid grid_;
    Eigen::MatrixXd angle_;  // basis of one angle at the grid points, without the function that turns the root
    Eigen::MatrixXd slope_;  // its derivative, 1/m
};

}  // namespace cardan::oracles
