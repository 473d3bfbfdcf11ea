/// @file
/// Texts and the numbers in them, always as in the C locale. A host program may have another one (std::locale::global,
/// setlocale), with decimal commas and groups of digits: everything that the library reads and writes goes through
/// here.
#pragma once

#include <charconv>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

namespace cardan {

/// An empty stream to write a text to, for widths and digits; text() does for everything else.
[[nodiscard]] inline std::ostringstream text_stream() {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    return out;
}

/// A stream that reads the words and lines of a text. Its numbers: read_number() of the words.
[[nodiscard]] inline std::istringstream text_reader(std::string all) {
    std::istringstream in(std::move(all));
    in.imbue(std::locale::classic());
    return in;
}

/// Concatenates its arguments as a stream would print them, with 10 significant digits.
template <class... Parts>
std::string text(const Parts&... parts) {
    std::ostringstream out = text_stream();
    out.precision(10);
    (out << ... << parts);
    return out.str();
}

/// The shortest digits that give the same double again: "0.1", "1e+300", "inf", "-nan".
[[nodiscard]] std::string digits(double value);
/// Text of a number in the given form with so many digits behind the point, as printf's %f and %e.
[[nodiscard]] std::string digits(double value, std::chars_format form, int places);

/// A word as a number.
struct ReadNumber {
    static constexpr std::string_view no_number = "is not a number", too_large = "does not fit into a double",
                                      infinite = "is not a finite number";
    double value = 0;
    std::string_view fault;  ///< one of these, empty for a finite number

    [[nodiscard]] bool good() const { return fault.empty(); }
};

/// The whole word as a decimal number, with a point, an exponent and a sign, if any: "-.5", "+2e3".
[[nodiscard]] ReadNumber read_number(std::string_view word);

/// Whether a byte is a digit of ASCII; no byte of another character is any of these.
[[nodiscard]] constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
[[nodiscard]] constexpr bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
[[nodiscard]] constexpr bool is_control(char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
}

/// Converts A ... Z to a ... z and leaves everything else as it is.
[[nodiscard]] constexpr char lower_case(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
[[nodiscard]] std::string lower_case(std::string_view text);
/// Converts a ... z to A ... Z and leaves everything else as it is.
[[nodiscard]] constexpr char upper_case(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

}  // namespace cardan
