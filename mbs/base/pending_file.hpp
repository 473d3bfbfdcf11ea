/// @file
/// A file that appears under its own name only when it is complete.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace cardan {

/// Contents are written to partial(), which lies beside path(); commit() renames it. An interrupted run therefore
/// leaves "<path>.partial" and the previous file under path(), if any, never half a result.
///
/// If two programs want to write the same file, the first one keeps it until it ends, however it ends: the partial file
/// is locked (flock), and a file that another program is writing is not replaced.
class PendingFile {
public:
    /// Checks that the file can be created, and creates an empty partial file or keeps the existing one. Throws
    /// FileError if the folder is missing, permission is lacking, path names a folder, a device or a pipe, or another
    /// program is writing the file (and says which).
    /// @param path  symbolic links are followed: they stay, and path() is what they lead to
    explicit PendingFile(const std::filesystem::path& path);
    ~PendingFile();
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] const std::string& partial() const { return partial_; }
    /// True if a killed program had left a partial file behind.
    [[nodiscard]] bool left_over() const { return left_over_; }

    /// Releases the lock on the partial file, for a library that locks it itself. In between another program may take
    /// it.
    void hand_over() const noexcept;
    /// The descriptor that holds the lock, for reading and writing; closing it is now up to the caller.
    [[nodiscard]] int release() const noexcept;
    /// Syncs the partial file to disk and renames it, replacing an older file. Throws FileError, also if another
    /// program has begun to write that file.
    /// @param replace  false: an older file is an error
    void commit(bool replace = true) const;
    /// Writes a whole text and commits it. Throws FileError; the previous file stays then, and no partial file is left.
    void complete(std::string_view contents) const;
    /// Removes the partial file, if it is there and no other program is writing it.
    void discard() const noexcept;

private:
    bool lock_partial();
    void give_name(bool replace) const;

    std::string path_;
    std::string partial_;
    bool left_over_ = false;
    mutable int fd_ = -1;  ///< holds the lock
};

/// Who has locked a file, as far as the system can tell.
std::string lock_holder(const std::string& path);

/// Writes a whole text through a PendingFile. On FileError the previous file stays, and no partial file is left.
void write_file(const std::filesystem::path& path, std::string_view contents);

}  // namespace cardan
