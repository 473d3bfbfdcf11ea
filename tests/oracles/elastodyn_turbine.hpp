#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace cardan::oracles {

/// A three-bladed machine as FAST's ElastoDyn sees it, written from positions of points: tower in two shapes fore-aft
/// and two side-side, yaw bearing locked, shaft on a torsional spring, generator locked, blades in two flap shapes and
/// one edge shape each. 14 coordinates.
///
/// Every mass point has a position r(q, psi) that is complete to second order in the deflections (a bent beam draws its
/// points towards its root by half the integral of the slope squared) and exact in the azimuth. Lagrange's equations of
/// points, sum m r_a . r'' = Q_a, are linearised about the periodic steady state under gravity; multi-blade
/// coordinates, mean over the azimuth. [J. Jonkman, FAST theory as of NREL/EL-500-38230, 2005; S. Bir, Multi-blade
/// coordinate transformation, NREL/CP-500-42553, 2008]
///
/// Integrals over the blades are sums over elements of equal length with the values at their middles, and so are the
/// shapes of the blades, from their curvatures; with many elements they are the integrals.
struct ElastodynTurbine {
    using Polynomial = std::array<double, 5>;  ///< coefficients of (x/L)^2 ... (x/L)^6

    struct Blade {
        std::vector<double> x, mass, EI_flap, EI_edge,
            twist;                         ///< from the root; linear in between; m, kg/m, N m^2, rad
        std::array<Polynomial, 3> shapes;  ///< flap, flap, edge
        double root_radius = 0, cone = 0;  ///< m; rad, tips downwind
        int elements = 17;
    } blade;
    struct Tower {
        std::vector<double> height, mass, EI;
        std::array<Polynomial, 4> shapes;  ///< fore-aft twice, side-side twice
        int elements = 20;
    } tower;
    double nacelle_mass = 0, nacelle_inertia = 0;     ///< kg; kg m^2 about the vertical through its mass centre
    double nacelle_x = 0, nacelle_z = 0;              ///< of the mass centre from the tower top, downwind and up, m
    double shaft_height = 0, tilt = 0, overhang = 0;  ///< m; rad, upwind end up; m upwind along the shaft
    double hub_mass = 0, hub_inertia = 0;             ///< kg at the apex; kg m^2 about the shaft
    double shaft_stiffness = 0;                       ///< N m/rad
    double gravity = 9.80665;

    struct Modes {
        Eigen::VectorXd hz;      ///< rising, undamped
        Eigen::MatrixXd shapes;  ///< |z|, one column per mode: tower 4, shaft, collective, cosine, sine of each shape
    };
    /// @param rotor_speed  rad/s; at 0 blade 1 points up
    /// @param azimuths     for the mean: multi-blade matrices have harmonics 0, 3, 6 ..., so 4 leave out what is below
    /// 12
    Modes modes(double rotor_speed, int azimuths = 4) const;
};

}  // namespace cardan::oracles
