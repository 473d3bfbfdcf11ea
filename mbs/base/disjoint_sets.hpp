/// @file
/// Sets of numbers that are joined until none has an element in common.
#pragma once

#include "mbs/base/entry.hpp"

#include <cstddef>
#include <numeric>
#include <vector>

namespace cardan {

/// Disjoint sets of the numbers 0 ... count - 1, each alone in its set to begin with.
class DisjointSets {
public:
    explicit DisjointSets(std::ptrdiff_t count) : parents_(static_cast<std::size_t>(count)) {
        std::iota(parents_.begin(), parents_.end(), std::ptrdiff_t{0});
    }

    /// The element that stands for the set of another.
    std::ptrdiff_t leader(std::ptrdiff_t i) {
        while (entry(parents_, i) != i) {
            entry(parents_, i) = entry(parents_, entry(parents_, i));  // halves the path
            i = entry(parents_, i);
        }
        return i;
    }
    /// The leader of `to` leads both from then on.
    void join(std::ptrdiff_t i, std::ptrdiff_t to) { entry(parents_, leader(i)) = leader(to); }

private:
    std::vector<std::ptrdiff_t> parents_;
};

}  // namespace cardan
