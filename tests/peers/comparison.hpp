/// @file
/// Cardan and another engine on the same tree and state.
#pragma once

#include "tests/peers/peer_links.hpp"
#include "tests/support/random_tree.hpp"

#include <array>
#include <functional>
#include <memory>
#include <string>

namespace cardan::peers {

/// Largest difference over the largest entry of Cardan's result, for every quantity compared.
struct Differences {
    double metric = 0;
    double bias = 0;         ///< Gamma qd qd by recursion
    double christoffel = 0;  ///< the same from the table of all symbols
    double gravity = 0;      ///< generalised forces of gravity
    double inverse = 0;      ///< inverse dynamics
    double forward = 0;      ///< forward dynamics, all coordinates free

    double largest() const;
    std::string text() const;
};

using Gravity = std::array<double, 3>;
/// Makes an engine for a tree. @throws PeerRefusal
using MakePeer = std::function<std::unique_ptr<Peer>(const std::vector<PeerLink>&, Gravity)>;

/// All quantities at a random state and under random forces and gravity. Cardan's model may have armatures: their share
/// is taken off, and forward dynamics is left out.
/// @param links  the model as the engine is given it; with pieces welded on, coordinates in the order of the model
Differences compare(const Model& model, const std::vector<PeerLink>& links, const MakePeer& make,
                    testing::Random& random);

/// Fails the test, and says by how much, if two quantities differ by more than 1e-9.
void require_equal(const Differences& d);

/// A random tree whose bodies carry further pieces, on frames at random places.
struct WeldedTree {
    Tree tree;                    ///< the pieces merged into their bodies
    std::vector<PeerLink> links;  ///< the pieces as links of their own, at the end
};
WeldedTree random_welded_tree(testing::Random& random, const testing::RandomTreeOptions& options, int pieces);

/// A chain in which every body with mass is carried by several joints with perpendicular axes through one point:
/// revolute ones (Cardan joints), of every other body the last prismatic. The bodies between are massless.
Tree chain_of_cardan_joints(testing::Random& random, int bodies, int joints);

}  // namespace cardan::peers
