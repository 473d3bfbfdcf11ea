#include "mbs/base/text_file.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

namespace cardan {

namespace {

/// Length in bytes of the first character of `text`; 0: not a valid character.
std::size_t character_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
    const unsigned first = byte(0);
    if (first < 0x80) return 1;
    const std::size_t length = first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
    // The second byte decides what the first leaves open: overlong forms, surrogates, beyond U+10FFFF.
    const unsigned min = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
    const unsigned max = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
    if (length == 0 || byte(1) < min || byte(1) > max) return 0;
    for (std::size_t i = 2; i < length; ++i)
        if (byte(i) < 0x80 || byte(i) > 0xBF) return 0;
    return length;
}

[[noreturn]] void refuse(std::string_view text, std::size_t at, std::string_view file, std::string_view what) {
    const std::string_view before = text.substr(0, at);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::string_view in_line = before.substr(before.rfind('\n') + 1);  // npos + 1 = 0
    const auto column = 1 + std::count_if(in_line.begin(), in_line.end(), [](char c) { return (c & 0xC0) != 0x80; });
    throw ParseError(file, static_cast<int>(line), static_cast<int>(column), what);
}

std::string hexadecimal(char c) {
    constexpr auto digits = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(c);
    return {'0', 'x', digits[byte >> 4], digits[byte & 15]};
}

std::string mebibytes(std::size_t bytes) {
    return cardan::text(bytes >> 20, " MiB");
}

}  // namespace

std::string text_file(const std::filesystem::path& path) {
    if (std::error_code code; std::filesystem::is_directory(path, code))
        throw FileError(path.string(), "is a folder, not a file");
    if (std::error_code code; std::filesystem::is_fifo(path, code))  // which may keep one waiting for ever
        throw FileError(path.string(), "is a pipe, not an ordinary file");
    errno = 0;
    std::ifstream in;
    in.imbue(std::locale::classic());
    in.open(path, std::ios::binary);
    std::string all;
    constexpr std::size_t piece = std::size_t{1} << 16;
    while (in && all.size() <= longest_text) {
        const std::size_t before = all.size();
        all.resize(before + piece);
        in.read(all.data() + before, piece);
        all.resize(before + static_cast<std::size_t>(in.gcount()));
    }
    if (all.size() > longest_text)
        throw FileError(path.string(), text("is longer than ", mebibytes(longest_text), ", the maximum of a text"));
    if (in.is_open() && !in.bad()) return all;
    const std::string reason = errno != 0 ? std::generic_category().message(errno) : "read error";
    throw FileError(path.string(), text("cannot be read: ", reason));
}

std::size_t utf8_length(std::string_view text) {
    std::size_t at = 0;
    while (at < text.size()) {
        const std::size_t length = character_length(text.substr(at));
        if (length == 0) break;
        at += length;
    }
    return at;
}

void require_text(std::string_view text, std::string_view file, TextRules rules) {
    if (text.size() > longest_text)
        throw ParseError(file, 1, 0,
                         cardan::text("a text of ", text.size(), " bytes; allowed: ", mebibytes(longest_text)));
    if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos)
        refuse(text, nul, file, "is no text: the character NUL; if it is UTF-16, save it as UTF-8");
    if (rules == TextRules::any_bytes) return;
    if (const std::size_t end = utf8_length(text); end < text.size())
        refuse(text, end, file, cardan::text("is not UTF-8: byte ", hexadecimal(text[end]), "; save it as UTF-8"));
}

}  // namespace cardan
