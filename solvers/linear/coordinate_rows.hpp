/// @file
/// Rows of a system over a list of coordinates.
#pragma once

#include <algorithm>
#include <vector>

namespace cardan::solvers {

/// Place of a coordinate in a list of them, or -1.
inline int row_of(const std::vector<int>& coordinates, int coordinate) {
    const auto at = std::find(coordinates.begin(), coordinates.end(), coordinate);
    return at == coordinates.end() ? -1 : static_cast<int>(at - coordinates.begin());
}

/// Places of some coordinates in a list, without those that are not there.
inline std::vector<int> rows_of(const std::vector<int>& coordinates, const std::vector<int>& some) {
    std::vector<int> rows;
    rows.reserve(some.size());
    for (const int coordinate : some)
        if (const int row = row_of(coordinates, coordinate); row >= 0) rows.push_back(row);
    return rows;
}

}  // namespace cardan::solvers
