/// @file
/// What two Campbell diagrams of one machine, by two methods, differ by.
#pragma once

#include "solvers/campbell/diagram.hpp"

namespace cardan::solvers {

/// One mode in both.
struct BranchDifference {
    std::string name, family;
    RotorPattern pattern = RotorPattern::none;
    /// Of damped frequency and damping ratio, by point, NaN where one has no such mode.
    std::vector<double> frequency_hz, damping_ratio;
    double largest_hz = 0;
};

/// Branches of the same name, `diagram` minus `reference`; as many points as both have.
/// @throws InputError unless both have the same rotor speeds and parameters, as far as they go
std::vector<BranchDifference> differences(const Campbell& diagram, const Campbell& reference);

/// Frequencies at the first, middle and last rotor speed above zero, and by how much those of the reference differ, for
/// a terminal.
std::string difference_table(const Campbell& diagram, const Campbell& reference);

}  // namespace cardan::solvers
