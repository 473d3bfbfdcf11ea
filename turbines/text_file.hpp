/// @file
/// The text of a file, or a clear error.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace cardan::turbines {

/// All bytes of the file.
/// @throws FileError: missing, a folder, not readable
[[nodiscard]] std::string text_file(const std::filesystem::path& path);

/// A ... Z as a ... z, everything else as it is, whatever the locale.
[[nodiscard]] std::string lower_case(std::string_view text);

}  // namespace cardan::turbines
