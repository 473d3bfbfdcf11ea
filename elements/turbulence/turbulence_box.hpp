/// @file
/// Turbulence that was made here: fluctuations on a grid, in memory.
#pragma once

#include "elements/wind/wind_box.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace cardan {

/// Fluctuations about the mean wind on a grid of points, periodic in time.
struct TurbulenceBox {
    BoxGrid grid;
    double speed = 0;                            ///< with which the air passes the grid, m/s
    std::array<std::vector<float>, 3> velocity;  ///< u, v, w of [step][row][column], m/s

    std::size_t index(int step, int row, int column) const {
        return static_cast<std::size_t>((std::ptrdiff_t{step} * grid.rows + row) * grid.columns + column);
    }
};

}  // namespace cardan
