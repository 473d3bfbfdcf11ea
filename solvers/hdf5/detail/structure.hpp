/// @file
/// Checks of structures that the C library follows blindly. In the HDF5 1.8 file format headers have checksums, and so
/// have the values of our data sets; but the chunk index of a data set (a version 1 B-tree) has none: if damaged, it
/// leads to wrong chunks, to none, in circles, or past the checksum of a chunk. So it is checked before values are
/// read. Format: "HDF5 File Format Specification, version 3.0", The HDF Group, sections III.A.1 and IV.A. Internal: not
/// for users of the library.
#pragma once

#include "solvers/hdf5/file.hpp"

#include <string>

namespace cardan::solvers::detail {

/// Checks the beginning of the file before the C library opens it: files that begin like ours have checksums from there
/// on.
/// @throws FileError
void check_beginning(const std::string& path);

/// Checks the chunk index of a one-dimensional data set of doubles: every chunk up to the end is present, once and in
/// its place in the file, with all its filters except deflate, which is skipped where it saves nothing.
/// @throws FileError
void check_chunks(const Hdf5File& file, const std::string& name);

}  // namespace cardan::solvers::detail
