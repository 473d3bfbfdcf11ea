/// @file
/// Cross sections of beams and their distribution along a reference line.
///
/// Beam axes: x along the beam, y and z across. Principal axes of a section are turned by beta about +x:
/// y' = cos(beta) y + sin(beta) z. With y toward the leading edge and z downwind a structural twist (positive: leading
/// edge upwind) is beta = -twist, EI_flap is EI about y' and EI_edge is EI about z'; offsets given toward the trailing
/// edge are negative y'.
#pragma once

#include "mbs/model/spatial.hpp"

#include <functional>
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

/// Sections along a beam: straight along x, or along the curve `axis`.
struct BeamLine {
    double length = 0;                                  ///< along the reference line, m
    std::vector<double> breaks = {};                    ///< where section or curve have kinks or jumps, ascending, m
    std::function<BeamSection(double x)> section = {};  ///< section at 0 <= x <= length, in the local axes
    std::string name = "beam";
    /// Pose of the section axes (x tangent) in beam axes; empty: straight, no rotation. See
    /// elements/sections/reference_line.hpp.
    std::function<Placement(double x)> axis = {};

    bool is_straight() const { return !axis; }
    Placement pose(double x) const { return axis ? axis(x) : Placement::translation({x, 0, 0}); }
    /// @throws InputError: length not positive, breaks not increasing, no section.
    void check() const;
};

/// @throws InputError: fewer than two stations, stations not finite and increasing (a station given twice is named), or
/// a different number of sections.
void check_stations(const std::string& name, const std::vector<double>& x, std::size_t sections);

/// Interpolation of the columns of a table between stations.
enum class Interpolation : std::uint8_t { linear, log_linear_stiffness };

/// Sections at stations. Mass, twist, offsets and inertias are linear between stations; stiffnesses are linear or
/// log-linear (ln EI, ln GJ linear). Infinite stiffnesses must be infinite at all stations.
class SectionTable {
public:
    /// @throws InputError: fewer than two stations, stations not increasing, bad section (station named).
    SectionTable(std::string name, std::vector<double> x, std::vector<EngineeringSection> sections,
                 Interpolation interpolation);
    EngineeringSection at(double x) const;
    BeamLine line() const;
    const std::vector<double>& stations() const { return x_; }

private:
    void check_rigid_directions() const;

    std::string name_;
    std::vector<double> x_;
    std::vector<EngineeringSection> sections_;
    Interpolation interpolation_;
};

/// A beam with the same section everywhere.
BeamLine uniform_beam(double length, const EngineeringSection& section, std::string name = "beam");

/// A straight tube of linear taper: outer diameter from base to top, wall thickness constant in each of the equal
/// conical sections; exact annulus, shear stiffness k G A, sectional inertia rho I.
struct TubeSpec {
    double length = 0, diameter_base = 0, diameter_top = 0;  ///< m
    std::vector<double> wall_thickness = {};                 ///< m, one per conical section from the base up
    double E = 0, G = 0, density = 0;                        ///< Pa, Pa, kg/m^3
    double shear_factor = 0.5;                               ///< k
};
BeamLine tube(const TubeSpec& spec, std::string name = "tube");

}  // namespace cardan
