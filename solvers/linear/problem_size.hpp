/// @file
/// Maximum size of a machine for analyses with full matrices.
#pragma once

#include <cstddef>
#include <string>

namespace cardan::solvers {

/// Eigenvalues of a full matrix take some 25 (2 n)^3 operations and eight matrices of (2 n)^2 numbers: this many
/// unknowns take minutes per point and 600 MB, six times as many a day and 20 GB.
inline constexpr std::size_t max_unknowns = 1500;

/// @param machine  named in the error
/// @throws InputError: none, or more than max_unknowns; with the reason and the remedy
void check_number_of_unknowns(const std::string& machine, std::size_t unknowns);

}  // namespace cardan::solvers
