#include "tests/peers/comparison.hpp"

#include "mbs/base/error.hpp"
#include "mbs/kernels/christoffel.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <limits>

namespace cardan::peers {

using namespace cardan::testing;

namespace {

double relative(const Matrix& difference, const Matrix& reference) {
    if (!difference.allFinite()) return std::numeric_limits<double>::infinity();  // a maximum may overlook NaN
    return difference.cwiseAbs().maxCoeff() / reference.cwiseAbs().maxCoeff();
}

// Generalised forces of gravity as Cardan computes them.
Vector gravity_forces(const Kinematics& kin, const Vec3& gravity, const Vector& q, const Vector& qd) {
    ForceSet set;
    set.set_gravity(gravity);
    Vector Q(kin.model().size());
    Forces(set, kin.model()).generalised_forces({{.q = q, .qd = qd}, kin}, Q);
    return Q;
}

}  // namespace

double Differences::largest() const {
    return std::max({metric, bias, christoffel, gravity, inverse, forward});
}

std::string Differences::text() const {
    return cardan::text("metric ", metric, ", bias ", bias, ", christoffel ", christoffel, ", gravity ", gravity,
                        ", inverse ", inverse, ", forward ", forward);
}

void require_equal(const Differences& d) {
    INFO(d.text());
    REQUIRE(d.largest() < 1e-9);
}

Differences compare(const Model& model, const std::vector<PeerLink>& links, const MakePeer& make, Random& random) {
    const int n = model.size();
    const Vector q = random_state(random, n), qd = random_state(random, n, 2), qdd = random_state(random, n, 3),
                 Q = random_state(random, n, 5), zero = Vector::Zero(n);
    const Vec3 gravity = random_vector(random, 10);
    const std::unique_ptr<Peer> weightless = make(links, {}), peer = make(links, {gravity(0), gravity(1), gravity(2)});

    Workspace workspace(model);
    const Kinematics kin = kinematics(model, q, workspace);
    Matrix g(n, n), armatures = Matrix::Zero(n, n), their_g(n, n);
    Vector bias(n), contracted(n), tau(n), theirs(n);
    Differences differences;

    metric<double>(kin, g);
    add_armatures<double>(model, armatures);
    peer->metric(q.data(), their_g.data());
    differences.metric = relative(g - armatures - their_g, g);

    inertial_forces<double>(kin, qd, bias);
    weightless->inverse_dynamics(q.data(), qd.data(), zero.data(), theirs.data());
    differences.bias = relative(bias - theirs, bias);

    Christoffel gamma(model);
    christoffel_first_kind(kin, gamma);
    gamma.contract(qd, contracted);
    differences.christoffel = relative(contracted - theirs, contracted);

    const Vector weight = gravity_forces(kin, gravity, q, qd);
    peer->inverse_dynamics(q.data(), zero.data(), zero.data(), theirs.data());
    differences.gravity = relative(weight + theirs, weight);

    inverse_dynamics<double>(kin, qd, qdd, tau);
    tau -= weight + armatures * qdd;
    peer->inverse_dynamics(q.data(), qd.data(), qdd.data(), theirs.data());
    differences.inverse = relative(tau - theirs, tau);

    if (!model.armatures().empty()) return differences;
    ForwardDynamics forward(model, std::vector<bool>(static_cast<std::size_t>(n), false));
    Vector acceleration(n), actuator(n);
    forward.solve(kin, qd, Q + weight, acceleration, actuator);
    peer->forward_dynamics(q.data(), qd.data(), Q.data(), theirs.data());
    differences.forward = relative(acceleration - theirs, acceleration);
    return differences;
}

WeldedTree random_welded_tree(Random& random, const RandomTreeOptions& options, int pieces) {
    WeldedTree welded{random_tree(random, options), {}};
    const Model bare(welded.tree);
    welded.links = peer_links(bare);
    for (int piece = 0; piece < pieces; ++piece) {
        const BodyId body{std::uniform_int_distribution<int>(0, options.bodies - 1)(random)};
        const Placement placement = random_placement(random);
        const RigidInertia inertia = random_inertia(random);
        welded.tree.weld(welded.tree.add_frame(welded.tree.frame_of(body), placement, text("piece ", piece)), inertia);
        welded.links.push_back(peer_link(bare.index(body), PeerJoint::weld, placement, inertia));
    }
    return welded;
}

Tree chain_of_cardan_joints(Random& random, int bodies, int joints) {
    Tree tree;
    FrameId inboard = Tree::base();
    for (int body = 0; body < bodies; ++body)
        for (int joint = 0; joint < joints; ++joint) {
            BodySpec spec;
            spec.name = text("body ", body, " joint ", joint);
            spec.inboard = inboard;
            // Perpendicular axes through one point; every other body slides along the last of its own.
            spec.placement = joint == 0 ? random_placement(random)
                                        : Placement::rotation(joint % 2 == 1 ? rot_x(pi / 2) : rot_y(pi / 2));
            const bool slides = joint == joints - 1 && body % 2 == 1;
            spec.joint = slides ? JointKind::prismatic : JointKind::revolute;
            if (joint == joints - 1) spec.inertia = random_inertia(random);
            inboard = tree.frame_of(tree.add_body(spec));
        }
    return tree;
}

}  // namespace cardan::peers
