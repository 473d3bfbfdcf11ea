/// @file
/// Laws of the springs of a cardanic element that are not linear in its joint coordinates: hinges at large angles,
/// elongation under shear.
#pragma once

#include "elements/cardan_beam/joint_stiffness.hpp"
#include "mbs/system/forces.hpp"

namespace cardan {

/// The springs store q^T K q / 2 in the joint coordinates q. At large angles better arguments y(q) may replace them; to
/// first order y = q.
struct HingeLaw {
    /// Each cardan joint bends by its swing vector (rotation vector of the beam axis) instead of its two angles: a beam
    /// of equal bending stiffnesses is then as stiff diagonally as along its axes.
    bool isotropic = false;
    /// The hinge angles are measured in the section as turned by the torsion between the clamped end and the hinge: for
    /// unequal bending stiffnesses with torsion.
    bool section_frame = false;
    /// The springs of sections flexible in shear, with extension free, measure the strains of a rod, not those of
    /// bodies tilted by shear (ShearTilt). Without it, as in the 2007 paper, refinement converges to a different rod.
    bool rod_strains = true;
    /// True if the law is linear in the hinge angles.
    bool is_linear() const { return !isotropic && !section_frame; }
};

/// Tilt by shear of the bodies between the hinges of an element although its sections do not turn, and which part of
/// that the springs must not measure. In terms of the springs' arguments y: psi = (psi_y, psi_z) = Psi y.
struct ShearTilt {
    /// z_spring = y_spring + ... + factor (a . y) (b . y)
    struct Product {
        Eigen::Index spring;
        double factor;
        Vec6 a, b;
    };
    Eigen::Matrix<double, 2, 6> rotation = {};  ///< Psi, columns beyond the free coordinates zero
    Eigen::Index extension = 0;                 ///< place of u among the free coordinates
    std::vector<Product> products = {};         ///< empty: rigid in shear, nothing to correct
};

/// Empty without free extension, and for elements rigid in shear.
/// @param mirrored  order of the cardan joints; for the other order the torsion axis is not corrected
ShearTilt shear_tilt(const ElementLine& element, const Hinges& hinges, CurvedFlexibility rule,
                     const std::vector<ElementCoordinate>& kinds, const Matrix& stiffness, bool mirrored);

/// The coordinates of one element to which a hinge law applies.
struct HingeLawElement {
    std::vector<BodyId> bodies;            ///< free coordinates of the element
    std::vector<ElementCoordinate> kinds;  ///< what they are
    Matrix stiffness;                      ///< K over them
    ShearTilt tilt = {};
};

/// The forces dV/dq of an element's springs along its joints; they act against the coordinates. V = z^T K z / 2, with z
/// = y(q) except for what tilting the bodies by psi = Psi y adds to the strains of a rod (s = 1 + u / d): under an
/// axial force,
///     z_u = y_u - s d |psi|^2 / 2,   z_az1 += (s - 1) psi_y, z_az2 -= (s - 1) psi_y,
///                                    z_ay1 -= (s - 1) psi_z, z_ay2 += (s - 1) psi_z,
/// since the tilt shortens the chain more than shear shortens a rod, and shears it by gamma = s d psi / L; and under
/// torsion, which acts about the bodies' axis instead of the sections',
///     z_phi -= psi_z (y_az1 + y_az2),   z_ay1, z_ay2 += phi psi_y / 2,   z_az1, z_az2 += phi psi_z / 2.
///                                                             [docs/theory.md, shear under axial force and torsion]
/// @param q  coordinates in the order of `kinds`
Vector hinge_forces(const HingeLaw& law, const HingeLawElement& element, const Vector& q);

/// The elastic forces Q = -dV/dq of the elements of a beam as one force, with exact Jacobian and energy. Without a law
/// for large angles (y = q) an element costs a few products of 6 x 6 matrices; nothing is allocated.
ForceElement hinge_law_force(const std::string& name, const HingeLaw& law, std::vector<HingeLawElement> elements);

}  // namespace cardan
