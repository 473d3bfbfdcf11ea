/// @file
/// Entries of lists by index: coordinates and bodies count in int, Eigen in Eigen::Index, lists in std::size_t.
#pragma once

#include <cassert>
#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>

namespace cardan {

/// list[i] of a vector, array or span, by an index of any integer type or an enumerator; 0 <= i < size is a
/// precondition.
template <class List, class Index>
constexpr decltype(auto) entry(List&& list, Index i) {
    static_assert(std::is_integral_v<Index> || std::is_enum_v<Index>);
    assert(static_cast<std::size_t>(i) < std::size(list));  // a negative index becomes a huge one
    return std::forward<List>(list)[static_cast<std::size_t>(i)];
}

}  // namespace cardan
