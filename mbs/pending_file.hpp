/// @file
/// A file that shows up under its own name only when it is complete.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace cardan {

/// The way from "being written" to "there": the contents go to partial(), which lies beside path(); commit() renames.
/// An interrupted run therefore leaves "<path>.partial" and whatever stood under path() before, never half a result.
class PendingFile {
public:
    /// Checks that the file can be made and creates an empty or keeps the existing partial one. Throws FileError when
    /// the folder is missing, permission is lacking, or path names a folder, a device or a pipe.
    explicit PendingFile(const std::filesystem::path& path);

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] const std::string& partial() const { return partial_; }

    /// Forces the partial file out to the disk and gives it its name, replacing an older file. Throws FileError.
    void commit() const;
    /// Removes the partial file, if it is there.
    void discard() const noexcept;

private:
    std::string path_;
    std::string partial_;
};

/// Writes a whole text on this way. Throws FileError; then what stood under the path stays, and nothing new beside it.
void write_file(const std::filesystem::path& path, std::string_view contents);

}  // namespace cardan
