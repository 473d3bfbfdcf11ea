// Forces given as functions: their derivatives, energy and time.
#include "mbs/base/error.hpp"
#include "tests/mbs/system/forced_tree.hpp"
#include "tests/support/catch.hpp"

#include <Eigen/Geometry>

using namespace cardan;
using namespace cardan::testing;

namespace {

// Nonlinear in q and qd, dependent on time and on the pose of a frame: a spring from the tip to the origin that hardens
// with time, and quadratic damping.
ForceElement hardening_spring(FrameId tip, bool with_jacobian) {
    ForceElement user{.name = "hardening spring", .points = {{Tree::base()}}};
    user.evaluate = [tip](const ElementView& in, ElementForces& out) {
        const Eigen::Index n = in.q.size();
        Matrix J(6, n);
        frame_jacobian<double>(in.system.kinematics, tip, J);
        const Vec3 p = pose(in.system.kinematics, tip).p;
        out.Q -= (1 + in.time) * J.bottomRows<3>().transpose() * p;
        out.Q.array() -= 0.2 * in.qd.array() * in.qd.array().abs();
    };
    user.potential = [tip](const ElementView& in) {
        return (1 + in.time) * pose(in.system.kinematics, tip).p.squaredNorm() / 2;
    };
    if (with_jacobian)
        user.jacobian = [tip](const ElementView& in, ElementJacobian& d) {
            const Model& model = in.system.kinematics.model();
            const Eigen::Index n = in.q.size();
            Matrix J(6, n);
            frame_jacobian<double>(in.system.kinematics, tip, J);
            const Vec3 p = pose(in.system.kinematics, tip).p;
            // d_b J_a = w_b x J_a for b proximal of a, J the velocity of the tip.
            for (int a = 0; a < n; ++a)
                for (int b = 0; b < n; ++b) {
                    const int proximal = std::min(a, b), distal = std::max(a, b);
                    const Vec3 w = J.col(proximal).head<3>(), v = J.col(distal).tail<3>();
                    const double turn = model.precedes(distal, model.frame(tip).body) ? p.dot(w.cross(v)) : 0.0;
                    d.Q_q(a, b) -= (1 + in.time) * (J.col(a).tail<3>().dot(J.col(b).tail<3>()) + turn);
                }
            d.Q_qd.diagonal().array() -= 0.4 * in.qd.array().abs();
        };
    return user;
}

}  // namespace

TEST_CASE("user forces: with and without their Jacobian the derivatives agree", "[property]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const auto make = [&](bool with_jacobian) {
            return ForcedTree(seed, [&](ForcedTree& at, ForceSet& set) {
                set.add_element(hardening_spring(at.add_tip(), with_jacobian));
            });
        };
        ForcedTree given = make(true), differenced = make(false);
        CHECK((given.Q() - differenced.Q()).isZero(0));
        CHECK(given.Q().norm() > 0);
        ForceDerivatives a, b;
        given.forces().derivatives({given, given.kin()}, a);
        const Kinematics kin = differenced.kin();
        differenced.forces().derivatives({differenced, kin}, b);
        CHECK(a.loads.norm() > 0.1);
        CHECK(scaled(a.loads - b.loads, a.loads) < 1e-8);
        CHECK(scaled(a.damping - b.damping, a.damping) < 1e-8);
        CHECK((a.damping.diagonal().array() >= 0).all());
        // Differencing leaves the caller's kinematics alone.
        const FrameId tip = given.model().frame("tip");
        CHECK((pose(kin, tip).p - pose(given.kin(), tip).p).isZero(0));
    }
}

TEST_CASE("user forces: a force with an energy is its gradient, and both see the time", "[property]") {
    ForcedTree s(11, [](ForcedTree& at, ForceSet& set) { set.add_element(hardening_spring(at.add_tip(), false)); });
    s.qd.setZero();
    const Vector Q = s.Q();
    CHECK(scaled(Q - minus_energy_gradient(s), Q) < 1e-10);
    const double energy = s.energy_at(s.q);
    s.time = 2 * s.time + 1;  // 1 + t doubles
    CHECK(s.energy_at(s.q) == Approx(2 * energy).epsilon(1e-14));
    CHECK((s.Q() - 2 * Q).norm() < 1e-13 * Q.norm());
}

TEST_CASE("user forces: a linear law written as a user force is the law, forces add up", "[property]") {
    for (unsigned seed = 0; seed < 10; ++seed) {
        const auto law = [](const ElementView& in, ElementForces& out) { out.Q -= 3 * in.q + 0.5 * in.qd; };
        ForcedTree user(seed, [&](ForcedTree& at, ForceSet& set) {
            set.set_gravity(random_vector(at.random));
            set.add_element({.name = "law", .points = {{Tree::base()}}, .evaluate = law});
            set.add_element({.name = "law again", .points = {{Tree::base()}}, .evaluate = law});
        });
        ForcedTree linear(seed, [&](ForcedTree& at, ForceSet& set) {
            set.set_gravity(random_vector(at.random));
            for (int k = 0; k < ForcedTree::n; ++k) set.add_spring(text("spring ", k), BodyId{k}, 6, 1);
        });
        const Vector Q = linear.Q();
        CHECK(scaled(user.Q() - Q, Q) < 1e-14);
    }
}
