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

}  // namespace cardan::solvers
