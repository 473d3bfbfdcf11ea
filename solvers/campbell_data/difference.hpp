/// @file
/// Differences between two Campbell diagrams of one machine, computed by two methods.
#pragma once

#include "solvers/campbell_data/diagram.hpp"

namespace cardan::solvers {

/// One mode in both.
struct BranchDifference {
    std::string name, family;
    RotorPattern pattern = RotorPattern::none;
    /// Differences of damped frequency and damping ratio by point; NaN where one diagram has no such mode.
    std::vector<double> frequency_hz, damping_ratio;
    double largest_hz = 0;
};

/// Differences of branches with the same name, `diagram` minus `reference`, over the points that both have.
/// @throws InputError unless both have the same rotor speeds and parameters, as far as they go
std::vector<BranchDifference> differences(const Campbell& diagram, const Campbell& reference);

/// Frequencies at the first, middle and last rotor speed above zero and their differences from the reference, as a
/// table for a terminal.
std::string difference_table(const Campbell& diagram, const Campbell& reference);

}  // namespace cardan::solvers
