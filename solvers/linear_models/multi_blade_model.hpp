/// @file
/// Linear models of rotors with three and more blades in the fixed frame.
#pragma once

#include "mbs/model/rotor_map.hpp"
#include "solvers/linear_models/linear_model.hpp"

namespace cardan::solvers {

/// A model whose matrices are averaged over the azimuth after multi-blade transformation. The mean is that of the state
/// matrices, with the inverse of M in them, and not of M, C and K as in azimuth_average(): the eigenvalues of the two
/// differ in the second order of what varies with the azimuth.
struct MultiBladeModel : ConstantModel {
    /// Largest difference between the transformed matrices at an azimuth and their mean, relative to the Frobenius norm
    /// of the mean: rounding for an isotropic rotor without gravity. Those of C and D are the largest over all outputs,
    /// each relative to its row (at least 1e-6 of the largest row among outputs in the same units).
    double A_remainder = 0, B_remainder = 0, C_remainder = 0, D_remainder = 0;
    /// Blade signals that were transformed: names without the number, "blade root moment y".
    std::vector<std::string> input_sets, output_sets;
};

/// Multi-blade (Coleman) transformation of states, and of the inputs and outputs that all blades have (names "blade 1
/// ..." to "blade B ..." that differ in nothing but the number):
///
///     x_k = x_0 + sum_n (x_cn cos n psi_k + x_sn sin n psi_k) [+ x_d (-1)^(k-1) for even B],
///     psi_k = psi + 2 pi (k-1)/B,
///
/// so that the collective value is the mean. Rates are transformed as rates of these: z' = ..., with the terms of
/// the turning frame in A. Rotating pairs (shaft bending) are turned into the fixed frame. The three inputs of a
/// prescribed pitch motion are transformed separately: cosine and sine components of the rates are not the derivatives
/// of those of the angles.
///                                                              [Bir, AIAA 2008-1300, with the same states]
/// @param rotor  of the model
/// @throws InputError as ColemanTransform; if there are fewer than three blades; if the model has another number of
/// blades; if the rotor turns and the azimuths, seen modulo 1/B of a revolution, are fewer than three: the remainder
/// would not show
MultiBladeModel multi_blade(const LinearModel& model, const RotorMap& rotor);

/// Checks that so many azimuths of a revolution are enough for a turning rotor.
/// @throws InputError unless the rotor stands in three different ways at them
void check_azimuths(std::size_t azimuths, int blades);

/// x = V z at an azimuth, for the states of multi_blade(): initial values for simulations.
Matrix multi_blade_states(const LinearModel& model, const RotorMap& rotor, double psi);

}  // namespace cardan::solvers
