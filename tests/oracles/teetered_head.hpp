#pragma once

#include <Eigen/Core>

#include <complex>

namespace cardan::oracles {

/// The rigid bodies of a two-bladed machine between tower and blades: nacelle, shaft, teetering hub, on a tower top
/// that moves in all six directions. Axes and letters of D. Lee, D. H. Hodges and M. J. Patil, Wind Energy 5 (2002),
/// Appendix A: n1 lateral, n2 along the shaft, n3 up; the shaft turns by psi = Omega t about n2, blade U is up at 0.
///
/// Speeds U: U1 angular velocity of the nacelle about its yaw axis; U2 of the hub about the teeter axis; U3 U4 U5 of
/// the tower top, U6 U7 U8 velocity of the tower top, along its own axes t. Angles: yaw q_y; teeter q_h, positive if
/// blade U moves toward +n2 (against U2). The masses lie at -c_n and -c_s along the shaft from the yaw axis, the teeter
/// axis at d_n2; from there the hub's mass at -c_h, the blade roots at -d_h1 along the shaft and +-d_h2 along the
/// blades. Those signs are what Appendix A has.
struct TeeteredHead {
    double c_n = 0, c_s = 0, c_h = 0, d_n2 = 0, d_h1 = 0, d_h2 = 0;  ///< m
    double m_y = 0, m_s = 0, m_h = 0;                                ///< kg
    Eigen::Vector3d I_y = Eigen::Vector3d::Zero();                   ///< nacelle: lateral, longitudinal, yaw, kg m^2
    double I_s_lat = 0, I_s_long = 0;                                ///< shaft, kg m^2
    Eigen::Vector3d I_h = Eigen::Vector3d::Zero();  ///< hub: teeter axis, shaft axis, along the blades, kg m^2
    double K_y = 0, C_y = 0, K_h = 0, C_h = 0;      ///< N m/rad, N m s/rad
    double Omega = 0;                               ///< rad/s
    double F_u = 0, F_d = 0;                        ///< steady axial forces at the blade roots, N

    /// What the linearised equations are linear in: the columns of linearised().
    enum Column {
        q_y = 0,
        q_h = 1,
        U = 2,       ///< U1 ... U8
        Ud = 10,     ///< their rates
        F_hat = 18,  ///< of blade U, then D, on the hub: 1 tension, 2 in the rotor plane, 3 along the shaft
        M_hat = 24,  ///< moments, the same axes
        F_t = 30,    ///< of the tower on its top, axes t
        M_t = 33,
        columns = 36
    };

    /// Kane's equations F_r + F_r* = 0, left sides for the eight speeds: exact, by vectors, no linearisation.
    /// @param x  as the columns above
    Eigen::Matrix<std::complex<double>, 8, 1> kane(const Eigen::Matrix<std::complex<double>, columns, 1>& x,
                                                   double psi) const;
    /// Their derivatives at rest in steady rotation, by complex steps.
    Eigen::Matrix<double, 8, columns> linearised(double psi) const;
    /// What does not vanish at rest: the steady axial forces, if they differ.
    Eigen::Matrix<double, 8, 1> at_rest(double psi) const;

    /// Appendix A as it is in the text at hand, read by machine (terms that belong together but were torn apart by a
    /// bracket are read as written).
    struct Printed {
        Eigen::Matrix<double, 8, columns> terms;
        Eigen::Matrix<double, 8, 1> at_rest;
    };
    Printed printed(double psi) const;
};

}  // namespace cardan::oracles
