/// @file
/// Headers of wind files of Bladed's kind. Internal to the readers: not installed.
#pragma once

#include "turbines/readers/detail/box_bytes.hpp"

namespace cardan::turbines {

/// The header of a .wnd.
struct BladedHeader {
    int components = 0;  ///< the first of u, v, w
    int planes = 0;      ///< as the length of the file says: twice the number in the header, or one more
    int rows = 0, columns = 0;
    double row_spacing = 0, column_spacing = 0, plane_spacing = 0;  ///< m
    double speed = 0;                                               ///< m/s
    std::array<double, 3> intensities = {};                         ///< of u, v, w, %; 0: not given
    std::size_t data = 0;                                           ///< byte at which the numbers begin

    std::size_t points() const { return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns); }
};

/// @throws FileError
BladedHeader read_bladed_header(const MappedFile& file);

/// Grid and components of a .wnd, int16 numbers as they are: scale 1; of components that are not there 0. The time
/// between its planes is that of a speed, m/s; the height of the lowest points is 0.
/// @param mirrored  columns run to the right
WindBoxData bladed_numbers(const MappedFile& file, const BladedHeader& header, double speed, bool mirrored);

}  // namespace cardan::turbines
