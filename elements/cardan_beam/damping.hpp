/// @file
/// Structural damping of beams.
#pragma once

#include "elements/sections/beam_line.hpp"

#include <array>

namespace cardan {

/// Fractions of critical damping of the modes of the beam clamped at its root with nothing attached, in order of
/// frequency: one list for all modes, or one per direction, a mode counting for the direction that holds most of its
/// elastic energy (in element axes). Modes beyond the end of a list get its last ratio times the ratio of frequencies,
/// so that high modes stay damped.
struct ModalRatios {
    std::vector<double> all = {};        ///< of every mode; the lists below must be empty then
    std::vector<double> bending_y = {};  ///< bending about y (flap of a blade)
    std::vector<double> bending_z = {};  ///< about z (edge)
    std::vector<double> torsion = {};
    std::vector<double> extension = {};
    bool empty() const {
        return all.empty() && bending_y.empty() && bending_z.empty() && torsion.empty() && extension.empty();
    }
};

/// Damping of a beam. The contributions add up; the default is none.
struct BeamDamping {
    BeamDamping() = default;  // not an aggregate: two bare numbers would be unreadable
    /// Stiffness-proportional by direction of strain, in the section's own axes, s: extension, shear y, shear z,
    /// torsion, bending about y', bending about z'. Damping stress = tau^(1/2) K tau^(1/2) strain rate, so equal
    /// entries give D = tau K also for coupled sections.
    std::array<double, 6> time_constants{};
    double mass_proportional = 0;  ///< 1/s; times the mass matrix of the clamped beam at rest
    ModalRatios modal = {};

    /// D = tau K with the given ratio at a frequency: tau = zeta / (pi f).
    static BeamDamping ratio_at(double ratio, double frequency_hz);
    /// D = alpha M + beta K of the clamped beam: zeta = alpha / (2 omega) + beta omega / 2.
    static BeamDamping rayleigh(double alpha, double beta);
    static BeamDamping of_modes(ModalRatios ratios);

    bool needs_modes() const { return mass_proportional > 0 || !modal.empty(); }
    /// @throws InputError: a negative or NaN entry, `all` together with another list
    void check(const std::string& where) const;
};

/// Dissipation per length S tau^(1/2) S^-1 tau^(1/2) S of section forces, in the axes of the compliance:
/// power = F^T G F for the section forces F of the strain rates. Strains are those at the reference line: bending about
/// a tension centre at a distance c stretches it, so with unequal coefficients of extension and bending the damping of
/// bending grows by EA c^2 (difference of tau^(1/2))^2; likewise torsion by the shear stiffness. Rigid directions
/// dissipate nothing; bending and torsion beside them keep their own coefficients.
Mat6 dissipation(const BeamSection& section, const std::array<double, 6>& time_constants);

/// Damping matrix from the mass and stiffness of a clamped beam: sum of 2 zeta_i omega_i (M phi_i)(M phi_i)^T with
/// mass-normalised modes phi_i, plus the mass-proportional part.
/// @param direction  of every coordinate: 0 extension, 1 torsion, 2 bending about y, 3 about z
Matrix component_damping(MatrixIn M, MatrixIn K, const std::vector<int>& direction, const BeamDamping& damping);

}  // namespace cardan
