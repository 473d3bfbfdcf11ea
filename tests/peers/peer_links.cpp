#include "tests/peers/peer_links.hpp"

namespace cardan::peers {

PeerLink peer_link(int parent, PeerJoint joint, const Placement& placement, const RigidInertia& inertia) {
    PeerLink link;
    link.parent = parent;
    link.joint = joint;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) link.R[3 * i + j] = placement.R(i, j);
        link.p[i] = placement.p(i);
        link.com[i] = inertia.com(i);
        link.J[i] = inertia.J(i, i);
    }
    link.mass = inertia.mass;
    link.J[3] = inertia.J(0, 1);
    link.J[4] = inertia.J(0, 2);
    link.J[5] = inertia.J(1, 2);
    return link;
}

std::vector<PeerLink> peer_links(const Model& model) {
    std::vector<PeerLink> links;
    for (const Model::Body& body : model.bodies())
        links.push_back(peer_link(body.parent, body.revolute ? PeerJoint::revolute : PeerJoint::prismatic, body.joint,
                                  body.inertia));
    return links;
}

}  // namespace cardan::peers
