/// @file
/// Campbell diagrams as HDF5 files; the layout is described in docs/file_formats.md.
#pragma once

#include "solvers/campbell_data/diagram.hpp"

#include <filesystem>

namespace cardan::solvers {

/// Writes everything the diagram holds: names, units, dimension scales, the input description, version, mode shapes as
/// motions of frames.
/// @throws FileError if the path cannot be written or the disk is full
void write_hdf5(const Campbell& diagram, const std::filesystem::path& path);

enum class CampbellShapes : std::uint8_t { leave, read };

/// Reads what tables, CSV files and pictures show: machine, method, remarks, branches with their eigenvalues,
/// crossings. Steady states and energies stay in the file; locked motions count as what their eigenvalues are.
/// @param shapes  read: also components and lines with their motions, for CampbellOptions::neighbour
/// @throws FileError if the file cannot be read, is no Campbell diagram, or has no shapes that are asked for
[[nodiscard]] Campbell read_campbell(const std::filesystem::path& path, CampbellShapes shapes = CampbellShapes::leave);

}  // namespace cardan::solvers
