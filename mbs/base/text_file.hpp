/// @file
/// Texts from outside: reading a file's bytes and checking that they are text.
#pragma once

#include "mbs/base/text.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace cardan {

/// The longest text that is read, 64 MiB; public turbine models have less than 1 MiB.
inline constexpr std::size_t longest_text = std::size_t{64} << 20;

/// All bytes of the file.
/// @throws FileError: missing, a folder, not readable, longer than longest_text
[[nodiscard]] std::string text_file(const std::filesystem::path& path);

/// Length in bytes of the longest valid UTF-8 prefix (The Unicode Standard, table 3-7: no overlong forms, no
/// surrogates, nothing above U+10FFFF); text.size() if the whole text is valid.
[[nodiscard]] std::size_t utf8_length(std::string_view text);
[[nodiscard]] inline bool is_utf8(std::string_view text) {
    return utf8_length(text) == text.size();
}

/// Whether bytes that are not UTF-8 are accepted.
enum class TextRules { utf8, any_bytes };

/// Rejects what is not text before a parser sees it: parsers mistake it for another encoding, the end of the file or a
/// very long line.
/// @throws ParseError with file, line and character column: a NUL character; longer than longest_text; and, with
/// TextRules::utf8, what is not UTF-8
void require_text(std::string_view text, std::string_view file, TextRules rules = TextRules::utf8);

}  // namespace cardan
