/// @file
/// Laws of the springs of a cardanic element that are not linear in its joint coordinates: hinges at large angles,
/// elongation under shear.
#pragma once

#include "elements/timoshenko.hpp"
#include "mbs/forces.hpp"

namespace cardan {

/// The springs store q^T K q / 2 in the joint coordinates q. At large angles better arguments y(q) may take their
/// place; to first order y = q.
struct HingeLaw {
    /// Each cardan joint bends by its swing vector (rotation vector of the beam axis) instead of its two angles: a beam
    /// of equal bending stiffnesses is then as stiff diagonally as along its axes.
    bool isotropic = false;
    /// The hinge angles are counted in the section turned by the torsion between the clamped end and the hinge:
    /// for unequal bending stiffnesses with torsion.
    bool section_frame = false;
    bool is_linear() const { return !isotropic && !section_frame; }
};

/// How the bodies between the hinges of an element turn by shear while its sections do not: (psi_y, psi_z) = Psi q.
struct ShearTilt {
    Matrix rotation = {};  ///< Psi over the free coordinates, 2 x n; empty: none
    double distance = 0;   ///< d of the hinges, m
};

/// Empty without free extension, and for elements rigid in shear.
ShearTilt shear_tilt(const ElementLine& element, const Hinges& hinges, CurvedFlexibility rule,
                     const std::vector<ElementCoordinate>& kinds, const Matrix& stiffness);

/// The bent coordinates of one element.
struct HingeLawElement {
    std::vector<BodyId> bodies;            ///< free coordinates of the element
    std::vector<ElementCoordinate> kinds;  ///< what they are
    Matrix stiffness;                      ///< K over them
    ShearTilt tilt = {};
};

/// The forces dV/dq of an element's springs along its joints, against the coordinates. V = z^T K z / 2, with z = y(q)
/// but for what an axial force would do to bodies that are tilted by psi = Psi y, s = 1 + u / d:
///     z_u = y_u - s d |psi|^2 / 2,   z_az1 = y_az1 + (s - 1) psi_y, z_az2 = y_az2 - (s - 1) psi_y,
///                                    z_ay1 = y_ay1 - (s - 1) psi_z, z_ay2 = y_ay2 + (s - 1) psi_z.
/// The tilt shortens the chain by more than shear does a rod, and shears it by gamma = s d psi / L.
///                                                                       [docs/theory.md, shear and axial force]
/// @param q  coordinates in the order of `kinds`
Vector hinge_forces(const HingeLaw& law, const HingeLawElement& element, const Vector& q);

/// The elastic forces Q = -dV/dq of the elements of a beam as one force, with exact Jacobian and energy. Without a law
/// for large angles (y = q) an element costs a few products of 6 x 6 matrices; nothing is allocated.
UserForce hinge_law_force(const std::string& name, const HingeLaw& law, std::vector<HingeLawElement> elements);

}  // namespace cardan
