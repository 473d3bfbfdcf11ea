#include "solvers/mode_names/community_names.hpp"

#include "mbs/base/text.hpp"

#include <algorithm>
#include <array>

namespace cardan::solvers {

namespace {

using Pair = std::pair<std::string_view, std::string_view>;

constexpr std::array short_families{Pair{"tower fore-aft", "Tower FA"}, Pair{"tower side-side", "Tower SS"},
                                    Pair{"drive-train torsion", "Drivetrain Torsion"},
                                    Pair{"rotor yaw", "Nacelle Yaw"}};
constexpr std::array short_patterns{Pair{"backward", "Regressive"}, Pair{"forward", "Progressive"}};

template <std::size_t n>
const Pair* find(const std::array<Pair, n>& pairs, std::string_view name) {
    const auto found = std::find_if(pairs.begin(), pairs.end(), [&](const Pair& pair) { return pair.first == name; });
    return found == pairs.end() ? nullptr : &*found;
}

// Every word with a capital letter.
std::string capitals(std::string_view words) {
    std::string out(words);
    for (std::size_t i = 0; i < out.size(); ++i)
        if (i == 0 || out[i - 1] == ' ') out[i] = upper_case(out[i]);
    return out;
}

template <std::size_t n>
std::string replaced(const std::array<Pair, n>& pairs, std::string_view name) {
    const Pair* known = find(pairs, name);
    return known ? std::string(known->second) : capitals(name);
}

// "platform surge": there is only one of each kind, so it gets no ordinal.
bool is_of_platform(std::string_view name) {
    return name.starts_with("platform ");
}

}  // namespace

std::string community_name(std::string_view name) {
    if (name.empty()) return {};
    if (is_of_platform(name)) return capitals(name);
    std::string ordinal = "1st";
    if (is_digit(name[0])) {
        const std::size_t blank = std::min(name.find(' '), name.size());
        ordinal = name.substr(0, blank);
        name.remove_prefix(std::min(blank + 1, name.size()));
    }
    const std::size_t bracket = name.find(" (");
    if (bracket == std::string_view::npos) return ordinal + " " + replaced(short_families, name);
    // "backward" or, with many blades, "backward, 2".
    const std::string_view inside = name.substr(bracket + 2, name.size() - bracket - 3);
    const std::size_t comma = std::min(inside.find(','), inside.size());
    return ordinal + " " + replaced(short_families, name.substr(0, bracket)) + " (" +
           replaced(short_patterns, inside.substr(0, comma)) + std::string(inside.substr(comma)) + ")";
}

std::string community_name(const Branch& branch) {
    return community_name(branch.name);
}

Campbell renamed(Campbell diagram, NameStyle style) {
    if (style == NameStyle::descriptive) return diagram;
    for (Branch& branch : diagram.branches) {
        branch.name = community_name(branch);
        for (std::string& name : branch.mostly) name = community_name(name);
        for (std::string& doubt : branch.doubt)
            for (const std::string_view before : {"mostly ", "also "})
                if (doubt.starts_with(before))
                    doubt = std::string(before) + community_name(std::string_view(doubt).substr(before.size()));
    }
    return diagram;
}

}  // namespace cardan::solvers
