/// @file
/// Frequencies of the two-bladed teetered machine of Lee, Hodges and Patil (2002), Table I, at 6.02 rad/s: tower modes
/// in the fixed frame, blade modes in the rotating frame.
#pragma once

#include <cstddef>
#include <vector>

namespace cardan::testing {

/// A mode of the machine at 6.02 rad/s, named as in half_turn_coordinates().
struct TeeteredRow {
    const char* family;
    std::size_t ordinal;  ///< from 1
    double exact, unit;   ///< per rev; what its digits leave open
};

/// Tower of a hundred times the blade's rigidity; converged by another implementation, digits as printed there.
inline const std::vector<TeeteredRow> teetered_ratio_100{
    {"tower lateral", 1, 0.7112, 1e-4},      {"tower fore-aft", 1, 0.7026, 1e-4},
    {"tower lateral", 2, 13.092, 1e-3},      {"tower fore-aft", 2, 12.856, 1e-3},
    {"tower torsion", 1, 136.67, 1e-2},      {"tower torsion", 2, 410.01, 1e-2},
    {"symmetric flap", 1, 3.557, 1e-3},      {"antisymmetric flap", 1, 10.167, 1e-3},
    {"symmetric flap", 2, 20.359, 1e-3},     {"antisymmetric flap", 2, 34.073, 1e-3},
    {"symmetric torsion", 1, 43.837, 1e-3},  {"antisymmetric torsion", 1, 44.18, 1e-2},
    {"symmetric torsion", 2, 131.480, 1e-3}, {"antisymmetric torsion", 2, 131.9, 0.5},
    {"symmetric lag", 1, 3.091, 1e-3},       {"antisymmetric lag", 1, 3.447, 1e-3},
    {"symmetric lag", 2, 19.771, 1e-3},      {"antisymmetric lag", 2, 20.118, 1e-3}};
/// Rigid tower.
inline const std::vector<TeeteredRow> teetered_rigid{
    {"symmetric flap", 1, 3.4015, 1e-4},     {"antisymmetric flap", 1, 10.167, 1e-3},
    {"symmetric flap", 2, 20.069, 1e-3},     {"antisymmetric flap", 2, 34.073, 1e-3},
    {"symmetric torsion", 1, 43.837, 1e-3},  {"antisymmetric torsion", 1, 43.875, 1e-3},
    {"symmetric torsion", 2, 131.480, 1e-3}, {"antisymmetric torsion", 2, 131.49, 1e-2},
    {"symmetric lag", 1, 3.2434, 1e-4},      {"antisymmetric lag", 1, 3.411, 1e-3},
    {"symmetric lag", 2, 19.712, 1e-3},      {"antisymmetric lag", 2, 20.018, 1e-3}};

}  // namespace cardan::testing
