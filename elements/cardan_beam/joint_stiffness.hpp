/// @file
/// Elastic law of the cardanic joint beam element.
#pragma once

#include "elements/cardan_beam/element_line.hpp"

#include <Eigen/Core>

#include <array>

namespace cardan {

/// (1 - 1/sqrt 3) / 2: hinges at the Gauss points, the default. Only this position converges at O(h^4) in bending with
/// true segment masses.
inline constexpr double delta_gauss = 0.21132486540518711775;

/// Positions of the joints of an element, as fractions of its length.
struct Hinges {
    double first, second;  ///< cardan joints
    double middle;         ///< cylindrical joint, between them
    static Hinges symmetric(double delta) { return {delta, 1 - delta, 0.5}; }
    /// Ends of the bodies B1 ... B4.
    std::array<double, 5> ends() const { return {0, first, middle, second, 1}; }
};

/// Joint coordinates of one element in the order of its law: extension, torsion, rotation about y at hinge 1 and 2,
/// rotation about z at hinge 1 and 2.
enum class ElementCoordinate : std::uint8_t { u, phi, ay1, ay2, az1, az2 };

/// Section forces (N, Vy, Vz, T, My, Mz) at x from the forces conjugate to (u, phi, ay1, ay2, az1, az2):
/// hinge moments are extrapolated linearly over the whole element, My' = Vz and Mz' = -Vy.
/// @param x      place in the element, 0 ... L, m
/// @param L      length of the element, m
/// @param hinges  any places 0 <= first < second <= 1
Mat6 section_forces_by_joint_forces(double x, double L, const Hinges& hinges);

/// Source of the flexibility of an element on a curve.
enum class CurvedFlexibility : std::uint8_t {
    curve,  ///< section forces evaluated on the curve, in local section axes: exact tip compliance of the curved piece
    chord   ///< the sections laid along the chord
};
/// Mean shear centre (0, y, z) of an element seen from its reference line, element axes, m: forces through it do not
/// twist the element. Zero if it cannot be twisted.
/// With the hinges on a line through it torsion does not shear that line. Otherwise the strain gamma = e kappa_x would
/// tilt the bodies between the hinges, which carry mass and moments, while the sections do not turn.
Vec3 shear_centre(const ElementLine& element);

/// Flexibility F = int H^T S H ds of an element; the joint stiffness is its inverse and reproduces the 6 x 6 tip
/// compliance of any section exactly, wherever the hinges are.
/// Rows and columns in the order of ElementCoordinate; entries of rigid directions are zero.
Mat6 joint_flexibility(const ElementLine& element, const Hinges& hinges,
                       CurvedFlexibility rule = CurvedFlexibility::curve);
/// The element [x0, x0 + L] of a line, hinges at delta L and (1 - delta) L.
Mat6 joint_flexibility(const BeamLine& line, double x0, double L, double delta);

/// Shear compliance of a section at zero twist, 1/N, from its compliance matrix. Torsion about an offset shear centre,
/// which shears the line, does not contribute.
Eigen::Matrix2d shear_at_zero_twist(const Mat6& compliance);

/// True if any section of the element is flexible in shear. Torsion about an offset shear centre, which shears the
/// line, does not count.
bool is_flexible_in_shear(const ElementLine& element);

/// The part (psi_y, psi_z) of the rotation of the bodies between the hinges that is due to shear, rad per unit of the
/// joint forces, in the order of ElementCoordinate: psi = int gamma ds / d, toward y and toward z, gamma the shear
/// strain of the hinge line from the sections' compliance and d the distance between the hinges. The sections
/// themselves do not rotate by it.
Eigen::Matrix<double, 2, 6> shear_rotation(const ElementLine& element, const Hinges& hinges,
                                           CurvedFlexibility rule = CurvedFlexibility::curve);

/// Joint stiffness over the chosen coordinates: the inverse of the flexibility without the rows and columns of those
/// that are locked (condensed at zero force, not clamped).
/// @throws InputError if the flexibility is singular there: a free direction of a rigid section; the message names the
/// coordinate and the option that locks it.
Matrix joint_stiffness(const Mat6& flexibility, const std::vector<ElementCoordinate>& coordinates,
                       const std::string& where);

/// Spring constants of a uniform element.            [Zhao et al. 2007, eq. 14-18; 17 and 18 are interchanged in print]
struct SpringConstants {
    double c21, c22, c23;  ///< bending, N m/rad: joint 1, between the terminal bodies, joint 2. c22 may be negative.
    double c11, c12;       ///< torsion GJ/L, N m/rad; extension EA/L, N/m
};
SpringConstants spring_constants(double EI, double GA, double GJ, double EA, double L, double delta);

}  // namespace cardan
