/// @file
/// Cross sections of beams.
///
/// Beam axes: x along the beam, y and z across. Principal axes of a section are turned by beta about +x:
/// y' = cos(beta) y + sin(beta) z. With y toward the leading edge and z downwind a structural twist (positive: leading
/// edge upwind) is beta = -twist, EI_flap is EI about y' and EI_edge is EI about z'; offsets given toward the trailing
/// edge are negative y'.
#pragma once

#include "mbs/model/spatial.hpp"

#include <limits>
#include <string>

namespace cardan {

/// Data of a section that the beam element needs, at the reference line and in beam axes.
struct BeamSection {
    Mat6 compliance =
        Mat6::Zero();  ///< strains (eps, gamma_y, gamma_z, kappa_x, kappa_y, kappa_z) by forces (N, Vy, Vz, T, My, Mz)
    double mass = 0;   ///< kg/m
    Vec3 centre = Vec3::Zero();  ///< centre of mass (0, y, z), m
    Mat3 J = Mat3::Zero();       ///< inertia per length about the centre of mass, kg m; Jxx = Jyy + Jzz
    double beta = 0;             ///< angle of the section's own axes about +x, rad: directions of damping and loads

    /// @throws InputError naming `where`: not finite, negative mass, mass centre out of the section's plane, compliance
    /// not symmetric (1e-9) or negative on its diagonal.
    void check(const std::string& where) const;
};

/// A point of a section in its principal axes, m.
struct SectionOffset {
    double y = 0, z = 0;
};

/// A section given by engineering constants.
struct EngineeringSection {
    double mass = 0;                                        ///< kg/m
    double EA = std::numeric_limits<double>::infinity();    ///< N; infinite: inextensible
    double GJ = std::numeric_limits<double>::infinity();    ///< N m^2
    double EI_flap = 0;                                     ///< about y', N m^2
    double EI_edge = 0;                                     ///< about z', N m^2
    double GA_y = std::numeric_limits<double>::infinity();  ///< shear stiffness along y', N; infinite: shear rigid
    double GA_z = std::numeric_limits<double>::infinity();  ///< along z', N
    double beta = 0;                                        ///< angle of the principal axes, rad
    SectionOffset mass_centre = {}, shear_centre = {}, tension_centre = {};
    double j_flap = 0;  ///< int rho z'^2 dA about the mass centre (turning about y'), kg m
    double j_edge = 0;  ///< int rho y'^2 dA about the mass centre (turning about z'), kg m

    BeamSection section() const;
    /// @throws InputError naming `where`: negative or NaN mass, stiffness or inertia; a bending stiffness of zero; a
    /// twist beyond half a turn (degrees?).
    void check(const std::string& where) const;
};

}  // namespace cardan
