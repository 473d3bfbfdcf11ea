/// @file
/// Boxes of HAWC2's kind: one file for each component, as generators of Mann turbulence write them.
#pragma once

#include "turbines/readers/wind_box_file.hpp"

#include <array>
#include <cstdint>
#include <filesystem>

namespace cardan::turbines {

/// Ways in which the numbers of a box become fluctuations of the wind.
enum class BoxScaling : std::uint8_t {
    none,       ///< they are m/s
    factors,    ///< times a factor for each component
    deviations  ///< times what gives each component a standard deviation at the middle point
};

/// A box of HAWC2's kind, whose files hold nothing but numbers.
struct Hawc2Box {
    std::array<std::filesystem::path, 3> files;                     ///< u, v, w
    int planes = 0, rows = 0, columns = 0;                          ///< along the wind, upward, across
    double plane_spacing = 0, row_spacing = 0, column_spacing = 0;  ///< m
    PlaneOrder order = PlaneOrder::first_first;
    BoxScaling scaling = BoxScaling::none;
    std::array<double, 3> factors = {1, 1, 1};
    std::array<double, 3> deviations = {};  ///< m/s
    /// Mean wind that is added. The air passes the grid with its speed, > 0; the middle of the grid is at its reference
    /// height.
    SteadyWind mean = {};
    double start = 0;  ///< x of the first plane at t = 0, m
};

/// Reads three files of float32 numbers, [plane][column from left to right][row upward]. Periodic; below the grid the
/// turbulence goes linearly to zero at the ground. With a scaling the mean of u at each point is taken off, as
/// InflowWind does. The middle point is, of an even number, the lower or the right one.
/// @throws InputError for sizes, spacings, factors and a mean wind out of range; FileError for files of another length
/// than the sizes ask for, numbers that are not finite (with their place), and a component that is to be scaled and
/// does not change
WindBoxFile read_hawc2_box(const Hawc2Box& given);

}  // namespace cardan::turbines
