/// @file
/// Texts from outside: the bytes of a file, and whether they are a text at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace cardan {

/// The longest text that is read, 64 MiB; public models of turbines have less than 1 MiB.
inline constexpr std::size_t longest_text = std::size_t{64} << 20;

/// All bytes of the file.
/// @throws FileError: missing, a folder, not readable, longer than longest_text
[[nodiscard]] std::string text_file(const std::filesystem::path& path);

/// Number of bytes up to the first that is no part of a character in UTF-8 (The Unicode Standard, table 3-7: no
/// overlong forms, no surrogates, nothing above U+10FFFF); text.size() if all of them are.
[[nodiscard]] std::size_t utf8_length(std::string_view text);
[[nodiscard]] inline bool is_utf8(std::string_view text) {
    return utf8_length(text) == text.size();
}

/// What is let through besides UTF-8.
enum class TextRules { utf8, any_bytes };

/// Parsers take what is not text for another encoding, for the end of the file or for a very long line: it is refused
/// before they see it.
/// @throws ParseError with file, line and character column: the character NUL; longer than longest_text; and by
///         TextRules::utf8 what is not UTF-8
void require_text(std::string_view text, std::string_view file, TextRules rules = TextRules::utf8);

/// A ... Z as a ... z, everything else as it is, whatever the locale.
[[nodiscard]] std::string lower_case(std::string_view text);

}  // namespace cardan
