/// @file
/// Frequencies of the two-bladed teetered machine that others give.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace cardan::teetered {

/// One mode, per revolution at 6.02 rad/s with the data of Table I of Lee, Hodges and Patil (2002).
struct KnownMode {
    std::string name;                 ///< as in a Campbell diagram
    std::string in_paper;             ///< the paper's name
    std::optional<double> reference;  ///< converged, by another method than the joint chain (docs/teetered.md)
    double digit = 0;                 ///< to which the reference is exact
    std::optional<double> paper;      ///< Tables II and III, four elements
    int figure = 0;                   ///< that shows it, 0: none
};

/// Known modes for a tower of `ratio` times the rigidity of the blades; rigid tower: infinite. References are known for
/// 100 and the rigid tower, values of the paper also for 10 and 1000; for other ratios there are names only.
std::vector<KnownMode> known_modes(double ratio);

}  // namespace cardan::teetered
