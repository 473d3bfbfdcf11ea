/// @file
/// A file that shows up under its own name only when it is complete.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace cardan {

/// The way from "being written" to "there": the contents go to partial(), which lies beside path(); commit() renames.
/// An interrupted run therefore leaves "<path>.partial" and whatever stood under path() before, never half a result.
///
/// Of two programs that want to write the same file the first one has it, until it ends in whatever way: the partial
/// file is locked (flock), and a file of that name that somebody is writing is not replaced.
class PendingFile {
public:
    /// Checks that the file can be made and creates an empty or keeps the existing partial one. Throws FileError when
    /// the folder is missing, permission is lacking, path names a folder, a device or a pipe, or another program is
    /// writing the file; then it says which.
    explicit PendingFile(const std::filesystem::path& path);
    ~PendingFile();
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] const std::string& partial() const { return partial_; }
    /// A partial file was there, which a program that was killed had left behind.
    [[nodiscard]] bool left_over() const { return left_over_; }

    /// Gives up the lock of the partial file for a library that locks it itself.
    void hand_over() const noexcept;
    /// Forces the partial file out to the disk and gives it its name, replacing an older file. Throws FileError, also
    /// if another program has begun to write that file.
    /// @param replace  false: an older file is an error
    void commit(bool replace = true) const;
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

/// Why a file cannot be had: who has locked it, as far as the system tells.
std::string who_has_it_open(const std::string& path);

/// Writes a whole text on this way. Throws FileError; then what stood under the path stays, and nothing new beside it.
void write_file(const std::filesystem::path& path, std::string_view contents);

}  // namespace cardan
