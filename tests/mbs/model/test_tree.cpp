// Trees and models: welding, frames, order, and what must not change the mechanics.
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/christoffel.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/point_masses.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/tree_tools.hpp"

#include <algorithm>
#include <numeric>

using namespace cardan;
using namespace cardan::testing;

namespace {

// All that the mechanics of a model says at one state.
struct Mechanics {
    Mechanics(const Model& model, const Vector& q, const Vector& qd, const Vector& qdd)
        : g(model.size(), model.size()), tau(model.size()), gamma(model) {
        Workspace workspace(model);
        const Kinematics kin = kinematics(model, q, workspace);
        metric(kin, g);
        inverse_dynamics<double>(kin, qd, qdd, tau);
        christoffel_first_kind(kin, gamma);
    }
    Matrix g;
    Vector tau;
    Christoffel gamma;
};

// to[a] is the coordinate of b that coordinate a of the first model corresponds to.
void require_same(const Mechanics& a, const Mechanics& b, const std::vector<int>& to, double tolerance) {
    const Eigen::Index n = a.tau.size();
    REQUIRE(b.tau.size() == n);
    const Matrix g_b = b.g(to, to);
    const Vector tau_b = b.tau(to);
    REQUIRE(max_abs(a.g - g_b) < tolerance * (1 + max_abs(a.g)));
    REQUIRE(max_abs(a.tau - tau_b) < tolerance * (1 + max_abs(a.tau)));
    double worst = 0, scale = 1;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k) {
                worst = std::max(worst, std::abs(a.gamma(i, j, k) - b.gamma(entry(to, i), entry(to, j), entry(to, k))));
                scale = std::max(scale, std::abs(a.gamma(i, j, k)));
            }
    REQUIRE(worst < tolerance * scale);
}

std::vector<int> identity_map(int n) {
    std::vector<int> map(static_cast<std::size_t>(n));
    std::iota(map.begin(), map.end(), 0);
    return map;
}

Vector permuted(const Vector& x, const std::vector<int>& to) {
    Vector y(x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) y(entry(to, i)) = x(i);
    return y;
}

}  // namespace

TEST_CASE("tree: welded bodies act as one body with the inertia of all points together", "[analytic]") {
    Random random(4);
    for (int i = 0; i < 20; ++i) {
        const std::vector<PointMass> own = random_points(random), welded = random_points(random),
                                     further = random_points(random);
        const Placement at = random_placement(random), at_frame = random_placement(random);
        std::vector<PointMass> all = own;
        for (const PointMass& p : welded) all.push_back({p.m, at * p.x});
        for (const PointMass& p : further) all.push_back({p.m, at * (at_frame * p.x)});

        const auto make = [&](const std::vector<PointMass>& points, bool weld) {
            Random same(static_cast<unsigned>(100 + i));  // the same tree around it
            Tree tree;
            BodySpec spec{.name = "carrier", .placement = random_placement(same), .inertia = inertia_of(points)};
            const FrameId carrier = tree.frame_of(tree.add_body(spec));
            const FrameId frame = tree.add_frame(carrier, at, "frame");
            const FrameId on_frame = tree.add_frame(frame, at_frame, "frame on the frame");
            tree.add_body({.name = "child",
                           .inboard = on_frame,
                           .placement = random_placement(same),
                           .joint = JointKind::prismatic,
                           .inertia = random_inertia(same)});
            if (weld) {
                tree.weld(frame, inertia_of(welded));
                tree.weld(on_frame, inertia_of(further), "part");
                tree.weld(Tree::base(), inertia_of(own), "foundation");
            }
            return Model(tree);
        };
        const Model parts = make(own, true), whole = make(all, false);
        const Vector q = random_state(random, 2), qd = random_state(random, 2), qdd = random_state(random, 2);
        require_same(Mechanics(parts, q, qd, qdd), Mechanics(whole, q, qd, qdd), identity_map(2), 1e-14);
        REQUIRE(parts.mass() == Approx(whole.mass()).epsilon(1e-14));
    }
}

TEST_CASE("tree: a frame on a frame moves with the body, a frame of the base stays", "[analytic]") {
    Random random(5);
    Tree tree;
    const FrameId ground = tree.add_frame(Tree::base(), random_placement(random), "ground");
    const Placement ground_at = entry(tree.frames(), ground.index).in_body;
    const Placement joint = random_placement(random), first = random_placement(random),
                    second = random_placement(random);
    const BodyId body =
        tree.add_body({.name = "body", .inboard = ground, .placement = joint, .inertia = random_inertia(random)});
    const FrameId at_first = tree.add_frame(tree.frame_of(body), first, "first");
    tree.add_frame(at_first, second, "second");
    const Model model(tree);
    Workspace workspace(model);
    const Vector q = Vector::Constant(1, 0.8);
    const Kinematics kin = kinematics(model, q, workspace);
    const Placement expected = ground_at * joint * Placement::rotation(rot_z(0.8)) * first * second;
    const Pose<double> actual = pose(kin, model.frame("second"));
    CHECK(max_abs(actual.R - expected.R) < 1e-14);
    CHECK(max_abs(actual.p - expected.p) < 1e-14);
    CHECK(max_abs(pose(kin, model.frame("ground")).R - ground_at.R) == 0);
    CHECK(max_abs(pose(kin, model.frame("ground")).p - ground_at.p) == 0);
    CHECK(max_abs(pose(kin, model.frame("base")).R - Mat3::Identity()) == 0);
    CHECK(model.frame("second") == tree.frame("second"));
    CHECK(model.frame(model.frame("second")).body == 0);
    CHECK(tree.frame_of(tree.body("body")) == tree.frame("body"));
}

TEST_CASE("model: bodies are sorted depth first, siblings in the order they were added", "[analytic]") {
    Random random(6);
    Tree tree;
    const auto add = [&](const char* name, FrameId inboard) {
        return tree.add_body({.name = name, .inboard = inboard, .inertia = random_inertia(random)});
    };
    const BodyId tower = add("tower", Tree::base());
    const BodyId mast = add("mast", Tree::base());
    const BodyId hub = add("hub", tree.frame_of(tower));
    const BodyId flag = add("flag", tree.frame_of(mast));
    const BodyId blade1 = add("blade 1", tree.frame_of(hub));
    const BodyId vane = add("vane", tree.frame_of(tower));
    const BodyId blade2 = add("blade 2", tree.frame_of(hub));
    const Model model(tree);
    const std::vector<BodyId> order{tower, hub, blade1, blade2, vane, mast, flag};
    const std::vector<int> parents{-1, 0, 1, 1, 0, -1, 5}, ends{5, 4, 3, 4, 5, 7, 7}, depths{1, 2, 3, 3, 2, 1, 2};
    for (std::size_t i = 0; i < order.size(); ++i) {
        const int k = static_cast<int>(i);
        CHECK(model.index(order[i]) == k);
        CHECK(model.body(k).name == entry(tree.bodies(), order[i].index).spec.name);
        CHECK(model.index(model.body(k).name) == k);
        CHECK(model.body(k).parent == parents[i]);
        CHECK(model.body(k).subtree_end == ends[i]);
        CHECK(model.body(k).depth == depths[i]);
    }
}

TEST_CASE("model: subtree ranges and precedence agree with the parents on random trees", "[property]") {
    for (unsigned seed = 0; seed < 100; ++seed) {
        Random random(seed);
        const Tree tree = random_tree(random, {.bodies = 15});
        const Model model(tree);
        const int n = model.size();
        for (int b = 0; b < n; ++b) {
            std::vector<bool> on_path(static_cast<std::size_t>(n), false);
            int depth = 0;
            for (int a = b; a >= 0; a = model.body(a).parent, ++depth) entry(on_path, a) = true;
            REQUIRE(model.body(b).parent < b);
            REQUIRE(model.body(b).depth == depth);
            for (int a = 0; a < n; ++a) {
                const bool precedes = entry(on_path, a);
                REQUIRE(model.precedes(a, b) == precedes);
                REQUIRE((b >= a && b < model.body(a).subtree_end) == precedes);
            }
        }
        for (int k = 0; k < n; ++k) {
            const Tree::Body& source = entry(tree.bodies(), k);
            const int at = model.index(BodyId{k});
            REQUIRE(model.body(at).name == source.spec.name);
            const int parent = model.body(at).parent;
            REQUIRE(parent == (source.parent < 0 ? -1 : model.index(BodyId{source.parent})));
        }
    }
}

TEST_CASE("coordinates: the table names, measures and sorts them", "[analytic]") {
    Random random(7);
    Tree tree;
    const auto add = [&](const char* name, JointKind joint, CoordinateInfo info) {
        tree.add_body({.name = name, .joint = joint, .inertia = random_inertia(random), .coordinate = info});
    };
    add("a", JointKind::revolute, {.name = "spin", .part = "shaft", .role = CoordinateRole::prescribed});
    add("b", JointKind::prismatic, {.name = "", .part = "blade", .blade = 1, .unit = "furlong"});
    add("c", JointKind::revolute, {.name = "pitch", .part = "blade", .blade = 2});
    const Model model(tree);
    const CoordinateTable& table = model.coordinates();
    CHECK(table.size() == 3);
    CHECK(table[0].unit == "rad");
    CHECK(table[1].unit == "m");
    CHECK(table[1].name == "b");
    CHECK(table.index("pitch") == 2);
    CHECK(table.free() == std::vector<int>{1, 2});
    CHECK(table.free_without(1) == std::vector<int>{2});
    CHECK(table.free_without(0) == std::vector<int>{1, 2});
    CHECK(table.free_without(-1) == std::vector<int>{1, 2});
    CHECK(table.parts() == std::vector<std::string>{"shaft", "blade"});
    CHECK(table.of_part("blade") == std::vector<int>{1, 2});
    CHECK(table.of_part("blade", 2) == std::vector<int>{2});
    CHECK(table.of_part("nacelle").empty());
}

TEST_CASE("model: the numbering of bodies changes neither g nor Gamma nor tau", "[property]") {
    for (unsigned seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const Tree tree = random_tree(random, {.bodies = 11, .armatures = seed % 2 == 0});
        // Any order in which parents come before their children.
        std::vector<int> order, ready;
        std::vector<bool> done(11, false);
        while (order.size() < 11) {
            ready.clear();
            for (int k = 0; k < 11; ++k) {
                const int parent = entry(tree.bodies(), k).parent;
                if (!entry(done, k) && (parent < 0 || entry(done, parent))) ready.push_back(k);
            }
            const std::size_t pick = std::uniform_int_distribution<std::size_t>(0, ready.size() - 1)(random);
            order.push_back(ready[pick]);
            entry(done, ready[pick]) = true;
        }
        Tree shuffled;
        const std::vector<BodyId> bodies = transplant(shuffled, Tree::base(), tree, order);
        const Model a(tree), b(shuffled);
        std::vector<int> to(11);
        for (int k = 0; k < 11; ++k) entry(to, a.index(BodyId{k})) = b.index(entry(bodies, k));
        const Vector q = random_state(random, 11), qd = random_state(random, 11), qdd = random_state(random, 11);
        require_same(Mechanics(a, q, qd, qdd), Mechanics(b, permuted(q, to), permuted(qd, to), permuted(qdd, to)), to,
                     1e-13);
    }
}

TEST_CASE("model: the form of input changes nothing: placements, parameters, joints on frames", "[property]") {
    for (unsigned seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const Tree tree = random_tree(random);
        Tree by_parameters, by_frames;
        for (int k = 0; k < static_cast<int>(tree.bodies().size()); ++k) {
            const Tree::Body& body = entry(tree.bodies(), k);
            BodySpec spec = body.spec;
            spec.inboard = body.parent < 0 ? Tree::base() : by_parameters.frame_of(BodyId{body.parent});
            by_parameters.add_body(spec, dh_parameters(body.in_parent));
            const FrameId parent = body.parent < 0 ? Tree::base() : by_frames.frame_of(BodyId{body.parent});
            const Placement detour = random_placement(random);
            spec.inboard = by_frames.add_frame(parent, detour, text("frame ", k));
            spec.placement = detour.inverse() * body.in_parent;
            by_frames.add_body(spec);
        }
        const Model a(tree), b(by_parameters), c(by_frames);
        const int n = a.size();
        const Vector q = random_state(random, n), qd = random_state(random, n), qdd = random_state(random, n);
        const Mechanics reference(a, q, qd, qdd);
        require_same(reference, Mechanics(b, q, qd, qdd), identity_map(n), 1e-12);
        require_same(reference, Mechanics(c, q, qd, qdd), identity_map(n), 1e-13);
    }
}

TEST_CASE("model: the zero of a coordinate and the origin on the axis of a revolute joint are free to choose",
          "[property]") {
    for (unsigned seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const Tree tree = random_tree(random);
        const int n = static_cast<int>(tree.bodies().size());
        const Vector offset = random_state(random, n), shift = random_state(random, n);
        Tree moved;
        std::vector<Placement> old_in_new;  // where the old body frame lies in the new one
        for (int k = 0; k < n; ++k) {
            const Tree::Body& body = entry(tree.bodies(), k);
            BodySpec spec = body.spec;
            const bool revolute = spec.joint == JointKind::revolute;
            const Placement slide = Placement::translation(shift(k) * Vec3::UnitZ());
            const Placement advance =
                revolute ? Placement::rotation(rot_z(offset(k))) : Placement::translation(offset(k) * Vec3::UnitZ());
            // new joint frame = old one, turned or slid to the offset, its origin shifted along the axis
            const Placement parent = body.parent < 0 ? Placement{} : entry(old_in_new, body.parent);
            spec.inboard = body.parent < 0 ? Tree::base() : moved.frame_of(BodyId{body.parent});
            spec.placement = parent * body.in_parent * advance * slide;
            old_in_new.push_back(slide.inverse());
            spec.inertia = spec.inertia.in(old_in_new.back());
            moved.add_body(spec);
        }
        const Model a(tree), b(moved);
        std::vector<int> map = identity_map(n);
        Vector q = random_state(random, n), q_moved = q;
        for (int k = 0; k < n; ++k) q_moved(a.index(BodyId{k})) -= offset(k);
        const Vector qd = random_state(random, n), qdd = random_state(random, n);
        require_same(Mechanics(a, q, qd, qdd), Mechanics(b, q_moved, qd, qdd), map, 1e-12);
    }
}

TEST_CASE("model: a sliding base weighs the total mass", "[analytic]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        Random random(seed);
        const Tree source = random_tree(random);
        double mass = 0;
        for (const Tree::Body& body : source.bodies()) mass += body.spec.inertia.mass;
        Tree tree;
        const BodySpec base =
            joint_spec("base slide", Tree::base(), JointKind::prismatic, random_vector(random).normalized());
        transplant(tree, tree.frame_of(tree.add_body(base)), source);
        const Model model(tree);
        CHECK(model.mass() == Approx(mass).epsilon(1e-14));
        const Vector q = random_state(random, model.size()), zero = Vector::Zero(model.size());
        const int at = model.index("base slide");
        CHECK(Mechanics(model, q, zero, zero).g(at, at) == Approx(mass).epsilon(1e-13));
    }
}

TEST_CASE(
    "tree: an armature adds J s s^T to the metric and nothing to the Christoffel symbols, factors of a repeated "
    "coordinate add up",
    "[analytic]") {
    Random random(8);
    Tree bare;
    FrameId inboard = Tree::base();
    for (int k = 0; k < 5; ++k)
        inboard = bare.frame_of(bare.add_body({.name = text("link ", k),
                                               .inboard = inboard,
                                               .placement = random_placement(random),
                                               .inertia = random_inertia(random)}));
    const std::vector<int> path{4, 2};
    Tree geared = bare;
    geared.add_armature({"gear", 0.3, {{BodyId{path[0]}, 1.5}, {BodyId{path[1]}, -2.0}, {BodyId{path[0]}, 0.5}}});
    const Model a(bare), b(geared);
    const Vector q = random_state(random, 5), qd = random_state(random, 5), qdd = random_state(random, 5);
    const Mechanics without(a, q, qd, qdd), with(b, q, qd, qdd);
    Vector s = Vector::Zero(5);
    s(b.index(BodyId{path[0]})) = 2.0;
    s(b.index(BodyId{path[1]})) = -2.0;
    CHECK(max_abs(with.g - without.g - 0.3 * s * s.transpose()) < 1e-14 * max_abs(with.g));
    CHECK(max_abs(with.tau - without.tau - 0.3 * s * s.dot(qdd)) < 1e-13);
    Workspace workspace(b);
    const Kinematics kin = kinematics(b, q, workspace);
    CHECK(kinetic_energy(kin, qd) == Approx(0.5 * qd.dot(with.g * qd)).epsilon(1e-13));
    ForwardDynamics forward(b);
    Vector back(5), actuator(5);
    forward.solve(kin, qd, with.tau, back, actuator);
    CHECK(max_abs(back - qdd) < 1e-11);
}
