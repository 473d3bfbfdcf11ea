/// @file
/// Thins out curves with very many points for plotting without losing peaks.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace cardan::solvers {

struct ThinnedCurve {
    std::vector<double> x, y;  ///< a y that is not finite is a gap
};

/// Envelope of a curve: in each of `columns` equal parts of the x-axis, for instance pixels of a picture, only the
/// first, smallest, largest and last value are kept, in their order: lines through them cover the same pixels as lines
/// through all points [Jugel et al., M4, PVLDB 7 (2014) 797-808]. Values are not altered, so extremes survive exactly.
/// A column that contains non-finite values ends in a gap. A curve with at most 4 points per column is left as it is.
/// @param x  rising
/// @throws InputError for different lengths, x descending or not finite, or no column
ThinnedCurve min_max_envelope(std::span<const double> x, std::span<const double> y, std::size_t columns);

}  // namespace cardan::solvers
