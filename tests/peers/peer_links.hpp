/// @file
/// A model as other engines are given it.
#pragma once

#include "mbs/model/model.hpp"
#include "tests/peers/peer.hpp"

namespace cardan::peers {

/// A link from its parts; `placement` is the joint frame at q = 0 in the frame of the link `parent`.
PeerLink peer_link(int parent, PeerJoint joint, const Placement& placement, const RigidInertia& inertia);

/// The bodies of a model, one link per coordinate and in its order. Armatures are left out: they are no bodies.
std::vector<PeerLink> peer_links(const Model& model);

}  // namespace cardan::peers
