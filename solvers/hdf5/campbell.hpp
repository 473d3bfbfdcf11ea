/// @file
/// Campbell diagrams as HDF5 files; the layout is described in docs/file_formats.md.
#pragma once

#include "solvers/campbell/diagram.hpp"

#include <filesystem>

namespace cardan::solvers {

/// Writes everything the diagram holds: names, units, dimension scales, the input description, version, mode shapes as
/// motions of frames.
/// @throws FileError if the path cannot be written or the disk is full
void write_hdf5(const Campbell& diagram, const std::filesystem::path& path);

/// Reads what tables, CSV files and pictures show: machine, method, remarks, branches with their eigenvalues,
/// crossings. Shapes, steady states and energies stay in the file; locked motions count as what their eigenvalues are.
/// @throws FileError if the file cannot be read, or is no Campbell diagram
[[nodiscard]] Campbell read_campbell(const std::filesystem::path& path);

}  // namespace cardan::solvers
