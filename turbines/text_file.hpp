/// @file
/// The text of a file, or a clear error.
#pragma once

#include <filesystem>
#include <string>

namespace cardan::turbines {

/// All bytes of the file.
/// @throws FileError: missing, a folder, not readable
[[nodiscard]] std::string text_file(const std::filesystem::path& path);

}  // namespace cardan::turbines
