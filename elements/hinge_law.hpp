/// @file
/// Laws of the hinges of a cardanic element at large angles.
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

/// The bent coordinates of one element.
struct HingeLawElement {
    std::vector<BodyId> bodies;            ///< free coordinates of the element
    std::vector<ElementCoordinate> kinds;  ///< what they are
    Matrix stiffness;                      ///< K over them
};

/// The forces (dy/dq)^T K y of an element's springs along its joints: against the coordinates.
/// @param q  coordinates in the order of `kinds`
Vector hinge_forces(const HingeLaw& law, const HingeLawElement& element, const Vector& q);

/// The elastic forces Q = -(dy/dq)^T K y of the elements of a beam as one force, with exact Jacobian and energy.
UserForce hinge_law_force(const std::string& name, const HingeLaw& law, std::vector<HingeLawElement> elements);

}  // namespace cardan
