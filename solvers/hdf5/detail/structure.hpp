/// @file
/// What the C library would follow without looking. Of the file format of HDF5 1.8, headers have checksums, and so have
/// the values of our data sets; the index of the chunks of a data set (a B-tree of version 1) has none: damaged, it
/// leads to other chunks, to none, in circles, or around the checksum of a chunk. So it is looked at before values are
/// read. Format: "HDF5 File Format Specification, version 3.0", The HDF Group, sections III.A.1 and IV.A.
/// Internal: not for users of the library.
#pragma once

#include "solvers/hdf5/file.hpp"

#include <string>

namespace cardan::solvers::detail {

/// The beginning of the file, before the C library opens it: files that begin as ours do have checksums from there on.
/// @throws FileError
void check_beginning(const std::string& path);

/// The index of the chunks of a data set with one axis of doubles: every chunk up to the end is there, once and in its
/// place in the file, with all its filters; but deflate, which is left out where it saves nothing.
/// @throws FileError
void check_chunks(const Hdf5File& file, const std::string& name);

}  // namespace cardan::solvers::detail
