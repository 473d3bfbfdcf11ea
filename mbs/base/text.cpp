#include "mbs/base/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <system_error>

namespace cardan {

std::string digits(double value) {
    std::array<char, 32> buffer{};
    return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

std::string digits(double value, std::chars_format form, int places) {
    // Sign, digits of the largest double, point; the places come in addition.
    std::string buffer(static_cast<std::size_t>(std::numeric_limits<double>::max_exponent10 + 8 + places), '\0');
    buffer.resize(static_cast<std::size_t>(
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, form, places).ptr - buffer.data()));
    return buffer;
}

ReadNumber read_number(std::string_view word) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    double value = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (code == std::errc::invalid_argument || end != word.data() + word.size()) return {0, ReadNumber::no_number};
    if (code == std::errc::result_out_of_range) return {0, ReadNumber::too_large};
    if (!std::isfinite(value)) return {0, ReadNumber::infinite};
    return {value, {}};
}

std::string lower_case(std::string_view text) {
    std::string out(text);
    std::ranges::transform(out, out.begin(), [](char c) { return lower_case(c); });
    return out;
}

}  // namespace cardan
