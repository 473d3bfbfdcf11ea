/// @file
/// Linkages with loops as other engines are given them.
#pragma once

#include "tests/mbs/loops/closed_trees.hpp"
#include "tests/peers/peer_links.hpp"

namespace cardan::peers {

/// The corners of the windows of four-bars that close them: the end of a coupler on the end of the next upright.
inline std::vector<PeerPin> pins(const cardan::testing::Windows& machine) {
    const Model& model = machine.system.model;
    std::vector<PeerPin> all;
    for (int i = 1; i <= machine.number; ++i)
        all.push_back({model.index(text("coupler ", i - 1)), model.index(text("upright ", i)), {1, 0, 0}, {1, 0, 0}});
    return all;
}

}  // namespace cardan::peers
