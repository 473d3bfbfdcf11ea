/// @file
/// Modes of a part with everything else clamped, and what they are named after.
#pragma once

#include "mbs/kernels/kinematics.hpp"
#include "mbs/model/rotor_map.hpp"
#include "solvers/mode_names/energy_shares.hpp"

#include <string>
#include <vector>

namespace cardan::solvers {

/// Names the axis of the part that each coordinate follows, at the q of the kinematics.
/// @param axes  of the part, in base axes
std::vector<std::string> coordinate_families(const Kinematics& kin, const PartAxes& part, const Mat3& axes,
                                             const std::vector<int>& own);
/// Names the axis of the part that each coordinate follows at q = 0, with the part's own axes.
std::vector<std::string> coordinate_families(const Model& model, const PartAxes& part, const std::vector<int>& own);

/// The family whose coordinates hold most of the energy of v.
std::string family_of(const Vector& v, const Matrix& K, const std::vector<std::string>& families);

/// Modes of a clamped part that store elastic energy, by frequency; shapes with x^T K x = 1.
struct ComponentModes {
    Vector omega;  ///< rad/s
    Matrix shapes;
};
/// @throws NumericalError naming the part
ComponentModes component_modes(const Matrix& K, const Matrix& M, const std::string& part);

/// sum += one.
/// @param reversed  of a negative frequency, which reverses the sense of whirl
void add(EnergyFraction& sum, const EnergyFraction& one, bool reversed);

}  // namespace cardan::solvers
