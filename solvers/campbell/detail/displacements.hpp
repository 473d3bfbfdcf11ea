/// @file
/// Motions in a Floquet analysis that are displacements: rigid ones, a free yaw joint, a free spin.
#pragma once

#include "solvers/campbell/diagram.hpp"

namespace cardan::solvers {

/// Exponents that are less, over the rotor speed, belong to rigid motions (a free spin): errors of the steady state
/// move a double zero by their square root.
inline constexpr double rigid_per_radian = 1e-4;
/// Limit for the free spin in the azimuthal average, where gravity on bent blades makes it a weak pendulum.
inline constexpr double free_spin_limit = 0.05;

/// A rigid displacement has no other harmonics, and no energy: what is there is rounding.
void keep_displacement(FloquetMode& mode);

/// A free displacement (yaw) is a double zero, which errors of the steady state split. What little else moves then may
/// have its energy in another harmonic, near a resonance, and that one was taken for the principal one.
/// @param M      mean mass matrix
/// @param speed  of the rotor, rad/s, > 0
void find_displacement(FloquetMode& mode, const Matrix& M, double speed);

/// Unbalance or gravity hold a free spin weakly, and then what it takes along once per revolution has more energy than
/// the spin itself. One motion is that of the spin, or two that do not oscillate: the slowest displacement of all.
/// @param spin  its row; -1: none
void find_weak_spin(std::vector<FloquetMode>& modes, const Matrix& M, double speed, Eigen::Index spin);

/// A free spin that is held weakly has little energy of its own, and what it takes along has springs. Beside the
/// slowest vibration, which is much faster, it is a displacement.
void name_weak_spin(std::vector<CampbellMode>& modes, const Matrix& M, Eigen::Index spin);

/// If several coordinates are free, any mixture of their displacements is a rigid motion, and rounding decides which
/// ones are found: those of one coordinate each take their place, as far as their number allows.
/// @param M  in rows of the modes' shapes
void separate_displacements(std::vector<CampbellMode>& modes, const Matrix& M);

}  // namespace cardan::solvers
