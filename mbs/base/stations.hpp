/// @file
/// Values given at stations, and linear interpolation between them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace cardan {

/// Place of a point among stations: between `left` and `right`, at the fraction t of the way.
struct StationPlace {
    std::size_t left, right;
    double t;

    /// Linear interpolation of the values at the stations.
    template <class T>
    T of(const std::vector<T>& values) const {
        return (1 - t) * values[left] + t * values[right];
    }
};

/// @param stations  ascending, at least two
/// @param x         beyond the ends the first or last interval is continued: t < 0 or t > 1
inline StationPlace place_among(const std::vector<double>& stations, double x) {
    const auto next = std::upper_bound(stations.begin() + 1, stations.end() - 1, x);
    const auto right = static_cast<std::size_t>(next - stations.begin());
    return {right - 1, right, (x - stations[right - 1]) / (stations[right] - stations[right - 1])};
}

}  // namespace cardan
