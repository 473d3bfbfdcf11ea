/// @file
/// The three components of a vector as channels. Internal to mbs/system: not installed.
#pragma once

#include "mbs/base/error.hpp"
#include "mbs/system/channel.hpp"

#include <string_view>

namespace cardan {

/// @param of_all  what they have in common; names and long names get the axis, these `after` behind it
inline void add_vector(std::vector<Channel>& channels, const Channel& of_all, std::string_view after = "") {
    for (const char axis : {'x', 'y', 'z'}) {
        Channel& added = channels.emplace_back(of_all);
        added.name = text(of_all.name, " ", axis);
        added.long_name = text(of_all.long_name, " ", axis, after);
    }
}

}  // namespace cardan
