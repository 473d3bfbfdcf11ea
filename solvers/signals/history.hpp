/// @file
/// Recorded time histories in memory.
#pragma once

#include "mbs/system/channel.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace cardan::solvers {

/// Channels over time.
struct History {
    std::string title;
    std::vector<Channel> channels;
    std::vector<double> time;                 ///< s, rising
    std::vector<std::vector<double>> values;  ///< one row per channel, as long as time

    /// Index of a channel by name or alias.  @throws InputError naming the channel and those that resemble it
    std::size_t index(std::string_view channel) const;
    const std::vector<double>& operator[](std::string_view channel) const { return values[index(channel)]; }
};

}  // namespace cardan::solvers
