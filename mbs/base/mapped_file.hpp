/// @file
/// Files that are mapped into memory: their bytes are fetched from the disk as they are used.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace cardan {

/// An ordinary file as a range of bytes, read-only, of any length: the system fetches pages as they are read and drops
/// them when it needs the memory.
///
/// A file that is renamed, removed or replaced by another of its name stays as it was mapped. One that another program
/// shortens in place is another matter: a read behind its new end raises SIGBUS, which by default ends the process, and
/// what is written into it may show here or not. require_whole() finds that out with one call of the system; between
/// that and a read it remains possible. Programs that write such files had better write them under another name and
/// rename them, as PendingFile does.
class MappedFile {
public:
    /// Maps the whole file.
    /// @throws FileError for what is missing, a folder, a device or a pipe, empty, or not readable
    explicit MappedFile(const std::filesystem::path& path);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }  ///< as it was given
    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
    /// Checks that the file is still as long as it was.  @throws FileError if it is not
    void require_whole() const;
    /// The time when the file was written last, ns: another one says that it may have changed in place.
    /// @throws FileError
    [[nodiscard]] std::int64_t written() const;

private:
    std::string path_;
    std::span<const std::byte> bytes_;
    int fd_ = -1;
};

}  // namespace cardan
