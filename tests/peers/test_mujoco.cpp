// Cardan beside MuJoCo: the same trees, two programs that share nothing.
#include "tests/peers/comparison.hpp"
#include "tests/peers/mujoco_peer.hpp"
#include "tests/support/catch.hpp"

using namespace cardan;
using namespace cardan::peers;
using namespace cardan::testing;

namespace {

std::unique_ptr<Peer> mujoco(const std::vector<PeerLink>& links, Gravity gravity) {
    return std::make_unique<MujocoPeer>(links, gravity);
}

}  // namespace

TEST_CASE("mujoco: metric, bias forces, gravity, inverse and forward dynamics of random trees", "[peers]") {
    for (unsigned seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const Model model(random_tree(random, {.bodies = 4 + static_cast<int>(seed % 12), .massless = 0}));
        CAPTURE(seed);
        require_equal(compare(model, peer_links(model), mujoco, random));
    }
}

TEST_CASE("mujoco: random trees with massless bodies, where these carry one other", "[peers]") {
    int compared = 0;
    for (unsigned seed = 0; seed < 100; ++seed) {
        Random random(seed);
        const Model model(random_tree(random));
        const std::vector<PeerLink> links = peer_links(model);
        CAPTURE(seed);
        try {
            mujoco(links, {});
        } catch (const PeerRefusal&) {
            continue;
        }
        require_equal(compare(model, links, mujoco, random));
        ++compared;
    }
    REQUIRE(compared >= 40);
}

TEST_CASE("mujoco: long random trees", "[peers]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        Random random(seed);
        const Model model(random_tree(random, {.bodies = 60, .massless = 0}));
        CAPTURE(seed);
        require_equal(compare(model, peer_links(model), mujoco, random));
    }
}

TEST_CASE("mujoco: pieces welded to bodies and their frames move as Cardan's merged bodies", "[peers]") {
    for (unsigned seed = 0; seed < 50; ++seed) {
        Random random(seed);
        const WeldedTree welded = random_welded_tree(random, {.bodies = 8, .massless = 0}, 6);
        CAPTURE(seed);
        require_equal(compare(Model(welded.tree), welded.links, mujoco, random));
    }
}

TEST_CASE("mujoco: several joints with one centre between bodies", "[peers]") {
    for (unsigned seed = 0; seed < 50; ++seed) {
        Random random(seed);
        const Model model(chain_of_cardan_joints(random, 5, 2 + static_cast<int>(seed % 2)));
        CAPTURE(seed);
        require_equal(compare(model, peer_links(model), mujoco, random));
    }
}

TEST_CASE("mujoco: what it cannot represent is refused with a reason", "[peers]") {
    const PeerLink massless = peer_link(-1, PeerJoint::revolute, {}, {});
    REQUIRE_THROWS_AS(MujocoPeer({massless}), PeerRefusal);
    // Moments of inertia of no body: A + B < C.
    const PeerLink reduced =
        peer_link(-1, PeerJoint::revolute, {}, {1, Vec3::Zero(), Vec3(1, 1, 3).asDiagonal().toDenseMatrix(), true});
    REQUIRE_THROWS_AS(MujocoPeer({reduced}), PeerRefusal);
}
