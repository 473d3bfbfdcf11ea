/// @file
/// Pictures of the mode shapes of a blade, through gnuplot.
#pragma once

#include "solvers/campbell_data/blade_shapes.hpp"

#include <filesystem>

namespace cardan::solvers {

/// One panel per mode, three in a row: flap and edge displacement (left axis, largest 1) and twist (right axis) over
/// the radius at the instant of the largest displacement. Symbols mark the nodes; between them run cubics with the
/// nodes' rotations as slopes. The file extension selects the format: .svg, .png or .pdf.
/// @throws InputError without modes; FileError, Error (gnuplot's message)
void plot(const BladeShapes& shapes, const std::filesystem::path& path);

}  // namespace cardan::solvers
