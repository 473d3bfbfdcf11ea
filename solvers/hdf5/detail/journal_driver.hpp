/// @file
/// HDF5 files on JournaledFile: what HDF5 writes comes into force at commit() only.
/// Internal: includes hdf5.h, not for users of the library.
#pragma once

#include "solvers/hdf5/detail/journal.hpp"
#include "solvers/hdf5/detail/storage.hpp"

namespace cardan::solvers::detail {

/// What an open file and its owner know of each other; outlives the file.
struct JournalLink {
    /// First error of the disk. As with writing_access(), HDF5 is told that all went well; nothing is committed then.
    DiskState* disk = nullptr;
    bool reading = false, synchronise = false;
    /// Closing the file commits. To be set when HDF5 has opened it, not earlier: it may be no HDF5 file; and to be
    /// taken back when a step of HDF5 fails halfway.
    bool commit_at_close = false;

    JournaledFile* file = nullptr;  ///< while it is open
    std::uint64_t end = 0;          ///< of the contents, as HDF5 has it
};

/// File access list. The file format is that of HDF5 1.8: metadata have checksums, and no mark in the file says that it
/// is open, so that every program reads a file whose writer was killed.
[[nodiscard]] Handle journaled_access(JournalLink& link);

/// Makes what H5Fflush() has written the contents of the file. Errors are noted in the link.
void commit(JournalLink& link);

}  // namespace cardan::solvers::detail
