/// @file
/// HDF5 files on JournaledFile: what HDF5 writes takes effect only at commit(). Internal: includes hdf5.h, not for
/// users of the library.
#pragma once

#include "solvers/hdf5/detail/journal.hpp"
#include "solvers/hdf5/detail/storage.hpp"

namespace cardan::solvers::detail {

/// State shared by an open file and its owner; outlives the file.
struct JournalLink {
    /// First disk error. As with writing_access(), HDF5 is given to understand that the write succeeded; nothing is
    /// committed after that.
    DiskState* disk = nullptr;
    bool reading = false, synchronise = false;
    /// Closing the file commits. Set it only once HDF5 has opened the file, since it may not be an HDF5 file, and reset
    /// it if an HDF5 operation fails halfway.
    bool commit_at_close = false;
    /// Descriptor that holds the lock of a new file until the file is open. HDF5 opens a new file twice, and in between
    /// no other program may get it.
    int held = -1;

    JournaledFile* file = nullptr;  ///< while it is open
    std::uint64_t end = 0;          ///< of the contents, according to HDF5
};

/// File access list. The file format is that of HDF5 1.8: metadata have checksums, and no mark in the file says that it
/// is open, so that any program can read a file whose writer was killed.
[[nodiscard]] Handle journaled_access(JournalLink& link);

/// Commits what H5Fflush() has written. Errors are recorded in the link.
void commit(JournalLink& link);

}  // namespace cardan::solvers::detail
