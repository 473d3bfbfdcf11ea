// Cardan beside Simbody: the same trees, two programs that share nothing.
#include "solvers/time/equations_of_motion.hpp"
#include "tests/peers/closed_links.hpp"
#include "tests/peers/comparison.hpp"
#include "tests/peers/simbody_peer.hpp"
#include "tests/support/catch.hpp"
#include "turbines/reference_turbines/wt600.hpp"

using namespace cardan;
using namespace cardan::peers;
using namespace cardan::testing;

namespace {

std::unique_ptr<Peer> simbody(const std::vector<PeerLink>& links, Gravity gravity) {
    return std::make_unique<SimbodyPeer>(links, gravity);
}

}  // namespace

TEST_CASE("simbody: metric, bias forces, gravity, inverse and forward dynamics of random trees", "[peers]") {
    for (unsigned seed = 0; seed < 100; ++seed) {
        Random random(seed);
        const Model model(random_tree(random, {.bodies = 4 + static_cast<int>(seed % 12)}));
        CAPTURE(seed);
        require_equal(compare(model, peer_links(model), simbody, random));
    }
}

TEST_CASE("simbody: long random trees", "[peers]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        Random random(seed);
        const Model model(random_tree(random, {.bodies = 60}));
        CAPTURE(seed);
        require_equal(compare(model, peer_links(model), simbody, random));
    }
}

TEST_CASE("simbody: pieces welded to bodies and their frames move as Cardan's merged bodies", "[peers]") {
    for (unsigned seed = 0; seed < 50; ++seed) {
        Random random(seed);
        const WeldedTree welded = random_welded_tree(random, {.bodies = 8}, 6);
        CAPTURE(seed);
        require_equal(compare(Model(welded.tree), welded.links, simbody, random));
    }
}

TEST_CASE("simbody: several joints with one centre between bodies", "[peers]") {
    for (unsigned seed = 0; seed < 50; ++seed) {
        Random random(seed);
        const Model model(chain_of_cardan_joints(random, 5, 2 + static_cast<int>(seed % 2)));
        CAPTURE(seed);
        require_equal(compare(model, peer_links(model), simbody, random));
    }
}

TEST_CASE("simbody: the 600 kW machine but for its armatures", "[peers]") {
    const turbines::Turbine turbine = turbines::wt600(turbines::wt600_paper_assembly());
    const Model& model = turbine.system().model;
    for (unsigned seed = 0; seed < 10; ++seed) {
        Random random(seed);
        CAPTURE(seed);
        require_equal(compare(model, peer_links(model), simbody, random));
    }
}

TEST_CASE("simbody: a link with moments of inertia and no mass is refused", "[peers]") {
    const PeerLink link = peer_link(-1, PeerJoint::revolute, {}, {0, Vec3::Zero(), Mat3::Identity()});
    REQUIRE_THROWS_AS(SimbodyPeer({link}), PeerRefusal);
}

TEST_CASE("simbody: accelerations of linkages with loops", "[peers]") {
    for (const int windows : {1, 2, 7}) {
        CAPTURE(windows);
        const Windows machine(windows, CutKind::spherical);
        const Model& model = machine.system.model;
        SimbodyPeer peer(peer_links(model), {0, -loop_gravity, 0}, pins(machine));
        const Vector q = machine.position(1.1), qd = machine.rates(-0.7), none = Vector::Zero(model.size());
        solvers::EquationsOfMotion equations(machine.system, {}, 0, q, qd);
        Vector x(2 * q.size()), ours(q.size()), theirs(q.size());
        x << q, qd;
        REQUIRE(equations.accelerations(0, x.data(), ours.data()));
        peer.closed_dynamics(q.data(), qd.data(), none.data(), theirs.data());
        CHECK((ours - theirs).norm() < 1e-9 * theirs.norm());
    }
}
