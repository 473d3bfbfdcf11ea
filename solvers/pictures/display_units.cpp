#include "solvers/pictures/display_units.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace cardan::solvers {

namespace {

bool is_pure_number(std::string_view units) {
    return units.empty() || units == "1" || units == "-";
}

std::vector<std::string_view> words(std::string_view all) {
    std::vector<std::string_view> found;
    for (std::size_t end = 0; !all.empty(); all.remove_prefix(std::min(end + 1, all.size()))) {
        end = std::min(all.find(' '), all.size());
        if (end > 0) found.push_back(all.substr(0, end));
    }
    return found;
}

struct Power {
    std::string_view unit;
    bool below = false;  // in the denominator
    char digit = '1';
};

// "s-2" -> s, below, 2
Power power_of(std::string_view word) {
    Power p{word};
    if (word.find_first_of("/^") != std::string_view::npos) return p;  // another notation
    if (word.size() < 2 || word.back() < '1' || word.back() > '9') return p;
    p.digit = word.back();
    word.remove_suffix(1);
    p.below = word.back() == '-';
    if (p.below) word.remove_suffix(1);
    return word.empty() ? Power{p.unit} : Power{word, p.below, p.digit};
}

std::string superscript(char digit) {
    constexpr std::array<const char*, 10> signs{"", "", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    return entry(signs, digit - '0');
}

}  // namespace

ShownUnits shown_units(const Channel& channel, AngleUnits angles) {
    if (angles == AngleUnits::degrees) {
        if (channel.units == "rad") return {units::to_degrees, "deg"};
        if (channel.units == "rad s-2" || channel.units == "rad/s^2") return {units::to_degrees, "deg s-2"};
        if (channel.units == "rad s-1" || channel.units == "rad/s") {
            if (channel.name.ends_with("speed")) return {units::to_rpm, "rpm"};
            return {units::to_degrees, "deg s-1"};
        }
    }
    return {1, channel.units};
}

ShownUnits with_prefix(std::string_view units, double largest) {
    constexpr std::array<std::string_view, 8> scaled{"N", "N m", "W", "J", "Pa", "var", "A", "V"};
    const bool downwards_only = units == "m" || units == "s";
    ShownUnits plain{1, std::string(units)};
    if (!downwards_only && std::find(scaled.begin(), scaled.end(), units) == scaled.end()) return plain;
    if (!(largest > 0) || !std::isfinite(largest) || (largest >= 0.01 && largest < 1000)) return plain;
    constexpr std::array<const char*, 7> prefix{"n", "µ", "m", "", "k", "M", "G"};
    const int thousands = std::clamp(static_cast<int>(std::floor(std::log10(largest * (1 + 1e-12)) / 3)), -3, 3);
    if (downwards_only && thousands > 0) return plain;
    const auto index = static_cast<std::size_t>(std::ptrdiff_t{3} + thousands);
    return {std::pow(1000.0, -thousands), prefix[index] + plain.units};
}

std::string display_text(std::string_view units) {
    if (is_pure_number(units)) return "pure number";
    std::string above, below;
    int factors_below = 0;
    for (std::string_view word : words(units)) {
        const Power p = power_of(word);
        std::string& side = p.below ? below : above;
        side += text(side.empty() ? "" : " ", p.unit, superscript(p.digit));
        factors_below += p.below;
    }
    if (below.empty()) return above;
    const bool several = factors_below > 1;
    return text(above.empty() ? "1" : above, "/", several ? "(" : "", below, several ? ")" : "");
}

std::string density_text(std::string_view units) {
    if (is_pure_number(units)) return "1/Hz";
    const std::string one = display_text(units);
    const bool simple = one.find_first_of(" /^²³") == std::string::npos;
    return simple ? text(one, "²/Hz") : text("(", one, ")²/Hz");
}

}  // namespace cardan::solvers
