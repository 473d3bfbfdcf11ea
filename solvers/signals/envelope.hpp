/// @file
/// Curves with very many points made small for a picture without losing a peak.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace cardan::solvers {

struct ThinnedCurve {
    std::vector<double> x, y;  ///< a y that is not finite is a gap
};

/// In each of `columns` equal parts of the x-axis, pixels of a picture for instance, only the first, the smallest, the
/// largest and the last value stay, in their order: lines through them cover the same pixels as lines through all
/// points [Jugel et al., M4, PVLDB 7 (2014) 797-808]. Values are kept as they are, so extremes survive exactly. A
/// column with values that are not finite ends in a gap. A curve with at most 4 points per column is left as it is.
/// @param x  rising
/// @throws InputError for lengths that do not agree, x falling or not finite, or no column
ThinnedCurve min_max_envelope(std::span<const double> x, std::span<const double> y, std::size_t columns);

}  // namespace cardan::solvers
