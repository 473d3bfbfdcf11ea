/// @file
/// Rows of AeroDyn's polars as a table around the circle. Internal to the readers: not installed.
#pragma once

#include "elements/aerodynamics/polar.hpp"
#include "turbines/readers/openfast_file.hpp"

#include <vector>

namespace cardan::turbines {

/// Numbers of the columns of the polars, from 1; 0: none.
struct PolarColumns {
    int angle, lift, drag, moment;
};

/// A polar's rows from -180 to 180 deg: a table from 0 to 360 deg is turned, one that ends before keeps the values of
/// its ends beyond them, as AeroDyn does with a warning; a row that repeats the one before counts once. All this is
/// noted.
/// @param notes  is added to
/// @throws ParseError for rows without these columns, angles that do not ascend or go beyond
Polar::Table polar_of_rows(const OpenFastFile& file, const std::vector<OpenFastFile::Row>& rows,
                           const PolarColumns& columns, std::vector<FileNote>& notes);

}  // namespace cardan::turbines
