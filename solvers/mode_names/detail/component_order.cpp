#include "solvers/mode_names/detail/component_order.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace cardan::solvers {

namespace {

using Order = std::vector<std::size_t>;

std::optional<Order> by_name(const std::vector<Component>& wanted, const std::vector<Component>& there) {
    Order order;
    for (const Component& c : wanted) {
        const auto found = std::ranges::find_if(there, [&](const Component& other) {
            return other.part == c.part && other.family == c.family && other.ordinal == c.ordinal;
        });
        if (found == there.end()) return std::nullopt;
        order.push_back(static_cast<std::size_t>(found - there.begin()));
    }
    return order;
}

Order sorted(const std::vector<Component>& components) {
    Order order(components.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t i, std::size_t j) {
        return std::pair(components[i].part, components[i].clamped_hz) <
               std::pair(components[j].part, components[j].clamped_hz);
    });
    return order;
}

std::optional<Order> by_frequency(const std::vector<Component>& wanted, const std::vector<Component>& there) {
    const Order in_wanted = sorted(wanted), in_there = sorted(there);
    Order order(wanted.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (wanted[in_wanted[i]].part != there[in_there[i]].part) return std::nullopt;
        order[in_wanted[i]] = in_there[i];
    }
    return order;
}

}  // namespace

std::optional<Order> component_order(const std::vector<Component>& wanted, const std::vector<Component>& there) {
    if (wanted.size() != there.size()) return std::nullopt;
    const std::optional<Order> order = by_name(wanted, there);
    return order ? order : by_frequency(wanted, there);
}

}  // namespace cardan::solvers
