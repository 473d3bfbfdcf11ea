/// @file
/// Loops of a circuit: a normal tree and what Kirchhoff's current law leaves free.
#pragma once

#include "mbs/base/types.hpp"

#include <string>
#include <vector>

namespace cardan::detail {

/// An edge of the graph; the rank says in which order edges are taken into the tree, smaller first.
struct CircuitEdge {
    std::string name;
    int from, to, rank;
};

/// Links, which are the edges outside of the tree, and the loops that they close: i = B j with the currents j of the
/// links.
struct CircuitLoops {
    std::vector<std::size_t> links;
    Matrix B;  ///< edges x links: 1, -1 or 0
    /// Names of the edges of a loop.
    std::string path(std::size_t loop, const std::vector<CircuitEdge>& edges) const;
};

CircuitLoops circuit_loops(const std::vector<CircuitEdge>& edges, int nodes);

}  // namespace cardan::detail
