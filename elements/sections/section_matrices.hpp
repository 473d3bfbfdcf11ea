/// @file
/// 6 x 6 stiffness and mass matrices of cross sections, as VABS, BECAS, BeamDyn and HAWC2 give them.
///
/// Forces are (N, Vy, Vz, T, My, Mz) at the reference point, strains (eps, gamma_y, gamma_z, kappa_x, kappa_y,
/// kappa_z), velocities (linear; angular): x along the beam, y and z across. With other axes, the same six in the order
/// (force x, y, z, moment x, y, z) of those axes.
#pragma once

#include "elements/sections/section.hpp"
#include "mbs/base/stations.hpp"

namespace cardan {

/// A direction in which the section is rigid has an infinite stiffness on the diagonal and couples with no other.
struct SectionMatrices {
    Mat6 stiffness = Mat6::Zero();  ///< forces by strains; N, N m, N m^2
    Mat6 mass = Mat6::Zero();       ///< momenta by velocities, per length; kg/m, kg, kg m
};

/// Linear interpolation between stations, of the entries.
SectionMatrices interpolated(const std::vector<SectionMatrices>& matrices, const StationPlace& place);

/// Axes of other programs in beam axes: columns are their x, y, z (R_beam_program). Beam axes of a blade: x outward,
/// y to the leading edge, z downwind.
Mat3 vabs_axes();     ///< x along the beam: the same
Mat3 beamdyn_axes();  ///< x downwind, y to the trailing edge, z along the blade
Mat3 hawc2_axes();    ///< x to the leading edge, y downwind (from the pressure to the suction side), z along the blade

/// A section's matrices in other axes.
/// @param R  R_ab, a proper rotation: matrices in axes b -> in axes a
/// @throws InputError if a rigid direction would not be along an axis any more
SectionMatrices rotated(const SectionMatrices& section, const Mat3& R);

/// A section's matrices about another reference point.
/// @param to  new reference point seen from the old one, m
/// @throws InputError if a rigid direction would couple with others there
SectionMatrices moved(const SectionMatrices& section, const Vec3& to);

/// A section that is turned by beta about +x, rad.
BeamSection turned(const BeamSection& section, double beta);

/// A section from its matrices in beam axes.
/// @param where  named in errors, e.g. "blade, station 3 (x = 4.1 m)"
/// @throws InputError: not finite, not symmetric (1e-6; the stiffness scaled to unit diagonal), an eigenvalue of the
/// stiffness not positive (its value: of the matrix scaled to unit diagonal) or of the inertia about the mass centre
/// negative; a mass matrix that is not that of a planar section (mass terms unequal, polar inertia more than 1 % off
/// the sum of the other two). A radius of gyration below 1e-7 m counts as none.
BeamSection beam_section(const SectionMatrices& section, const std::string& where);

/// Matrices of a section.
/// @throws InputError if it is rigid in a direction that is not along an axis
SectionMatrices section_matrices(const BeamSection& section);

/// The engineering constants that approximate a section best.
struct EngineeringForm {
    EngineeringSection section;
    /// Coupling that engineering constants cannot express (bend-twist, extension-twist ..., principal axes of inertia
    /// apart from those of bending): the largest error of the compliance over the root of its diagonal entries, and of
    /// the inertia over its largest moment. Up to rounding (1e-12) the form is exact.
    double coupling = 0;
};
/// Principal axes of bending at most 45 degrees from the beam axes, centres, and stiffnesses about them.
EngineeringForm engineering_form(const BeamSection& section);

}  // namespace cardan
