#include "solvers/signals/history.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace cardan::solvers {

namespace {

// Edit (Levenshtein) distance without regard to case; small if one name contains the other.
std::size_t distance(std::string_view a, std::string_view b) {
    const auto same = [](char x, char y) { return lower_case(x) == lower_case(y); };
    if (a.size() > b.size()) std::swap(a, b);
    if (a.size() > 2 && std::search(b.begin(), b.end(), a.begin(), a.end(), same) != b.end()) return 1;
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (same(a[i], b[j]) ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
        }
    }
    return row.back();
}

// Names and aliases next to what was asked for.
std::string resembling(const std::vector<Channel>& channels, std::string_view wanted) {
    constexpr std::size_t max = 8;
    std::vector<std::pair<std::size_t, const std::string*>> near;
    for (const Channel& channel : channels)
        for (const std::string* name : {&channel.name, &channel.alias})
            if (!name->empty()) near.emplace_back(distance(*name, wanted), name);
    const auto by_distance = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::stable_sort(near.begin(), near.end(), by_distance);
    std::string names;
    for (std::size_t i = 0; i < std::min(max, near.size()); ++i)
        names += text(i == 0 ? "" : ", ", "'", *near[i].second, "'");
    return near.size() > max ? text(names, " ... (", channels.size(), " channels in all)") : names;
}

}  // namespace

std::size_t History::index(std::string_view channel) const {
    for (std::size_t i = 0; i < channels.size(); ++i)
        if (channels[i].name == channel || (!channel.empty() && channels[i].alias == channel)) return i;
    throw InputError(text("history '", title, "'"), "channel", text("'", channel, "'"),
                     channels.empty() ? "none: it has no channels" : text("one of ", resembling(channels, channel)));
}

}  // namespace cardan::solvers
