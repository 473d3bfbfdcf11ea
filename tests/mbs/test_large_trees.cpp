// What a large tree costs: memory in proportion to its bodies, no recursion, and an error where memory runs out.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/geometry/curvature.hpp"
#include "mbs/kernels/christoffel.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "mbs/system/system.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/little_memory.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

enum class Shape { chain, bush, comb };

// Bodies k = 1 ... n; what each stands on says the shape. Axes alternate, so that every chain can bend and twist.
Tree large_tree(int n, Shape shape) {
    Tree tree;
    std::vector<FrameId> own;
    for (int k = 0; k < n; ++k) {
        const bool on_base = k == 0 || shape == Shape::bush;
        const int carrier = shape == Shape::comb && k % 2 == 1 ? k - 1 : k - 1 - k % 2;
        BodySpec spec;
        spec.name = text("link ", k);
        if (!on_base) spec.inboard = entry(own, shape == Shape::chain ? k - 1 : carrier);
        spec.placement = {k % 2 == 0 ? rot_x(0.7) : rot_y(-0.4), Vec3(0, 0, 0.5)};
        spec.inertia = {2, Vec3(0, 0.1, 0.25), Vec3(0.3, 0.4, 0.2).asDiagonal()};
        own.push_back(tree.frame_of(tree.add_body(spec)));
    }
    return tree;
}

std::size_t bytes_of_tree_and_model(int n, Shape shape) {
    const AllocationGuard guard;
    const Tree tree = large_tree(n, shape);
    ForceSet forces;
    for (int k = 0; k < n; ++k) forces.add_spring(text("spring ", k), BodyId{k}, 10);
    const System system(tree, forces);
    const Workspace workspace(system.model);
    return system.model.size() == n ? guard.bytes() : 0;
}

}  // namespace

TEST_CASE("large trees: tree, forces, model and workspace need memory in proportion to the bodies", "[property]") {
    if (!AllocationGuard::works()) return;
    for (const Shape shape : {Shape::chain, Shape::bush, Shape::comb}) {
        const std::size_t small = bytes_of_tree_and_model(2000, shape), large = bytes_of_tree_and_model(8000, shape);
        CAPTURE(static_cast<int>(shape), small, large);
        CHECK(small > 0);
        // Vectors that double as they grow add up to as much again at the worst place.
        CHECK(static_cast<double>(large) < 4 * 1.6 * static_cast<double>(small));
    }
}

TEST_CASE("large trees: 100000 bodies in a chain and in a bush become a model, with exact masses", "[property]") {
    for (const Shape shape : {Shape::chain, Shape::bush}) {
        constexpr int n = 100000;
        const Model model(large_tree(n, shape));
        REQUIRE(model.size() == n);
        CHECK(model.body(n - 1).depth == (shape == Shape::chain ? n : 1));
        CHECK(model.mass() == 2.0 * n);
    }
}

TEST_CASE("large trees: the inverse of the forward dynamics holds on a chain of 5000 bodies", "[property]") {
    constexpr int n = 5000;
    const Model model(large_tree(n, Shape::chain));
    Workspace workspace(model);
    Random random(1);
    const Kinematics kin = kinematics(model, random_state(random, n, 0.3), workspace);
    const Vector qd = random_state(random, n, 1e-3), Q = random_state(random, n);
    Vector qdd = Vector::Zero(n), actuator(n), tau(n);
    ForwardDynamics(model).solve(kin, qd, Q, qdd, actuator);
    inverse_dynamics<double>(kin, qd, qdd, tau);
    CHECK((tau - Q).norm() < 1e-6 * Q.norm());
}

TEST_CASE("large trees: a coordinate without inertia is found at either end of a chain", "[property]") {
    for (const bool at_tip : {false, true}) {
        Tree tree;
        FrameId at = Tree::base();
        const auto add = [&](const std::string& name, const RigidInertia& inertia) {
            at = tree.frame_of(tree.add_body({.name = name, .inboard = at, .inertia = inertia}));
            at = tree.add_frame(at, {rot_x(0.9), Vec3(0, 0, 0.5)}, name + " end");
        };
        if (!at_tip) {  // two joints about one axis with nothing between them
            at = tree.frame_of(tree.add_body({.name = "first"}));
            add("second", {});
        }
        for (int k = 0; k < 3000; ++k) add(text("link ", k), {1, Vec3(0, 0.1, 0.2), Mat3::Identity()});
        if (at_tip) add("vane", {});
        check_refused([&] { Model{tree}; }, {"singular metric", at_tip ? "'vane'" : "'second'"});
    }
}

// The metric with unit diagonal: its smallest eigenvalue, by another algorithm.
TEST_CASE("singular metric: a model is refused exactly where the scaled metric has no positive smallest eigenvalue",
          "[property]") {
    int refused = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const Tree source = random_tree(random, {.bodies = 6, .armatures = true});
        // A negative armature over two coordinates takes ever more of the inertia of the bodies.
        Tree tree = source;
        const int tip = static_cast<int>(tree.bodies().size()) - 1;
        int middle = tree.bodies().back().parent;
        if (middle < 0) middle = tip;
        const Model plain(tree);
        Workspace workspace(plain);
        Matrix g(6, 6);
        metric<double>(kinematics(plain, Vector::Zero(6), workspace), g);
        Vector s = Vector::Zero(6);
        s(plain.index(BodyId{tip})) = 1;
        s(plain.index(BodyId{middle})) += 0.4;
        const double limit = 1 / s.dot(g.llt().solve(s));  // g - J s s^T is singular there
        for (const double share : {0.5, 0.999, 1.001, 3.0}) {
            Tree with = source;
            with.add_armature({"taken", -share * limit, {{BodyId{tip}, 1}, {BodyId{middle}, 0.4}}});
            const Matrix rest = g - share * limit * s * s.transpose();
            const double lowest = Eigen::SelfAdjointEigenSolver<Matrix>(rest).eigenvalues()(0);
            CAPTURE(seed, share, lowest);
            const bool accepted = refusal([&] { Model{with}; }) == "(accepted)";
            CHECK(accepted == (lowest > 0));
            refused += accepted ? 0 : 1;
        }
    }
    CHECK(refused == 120);
}

TEST_CASE("large trees: memory that runs out is an error that says for what", "[property]") {
    if (!AllocationGuard::works()) return;
    constexpr int n = 60000;
    const Model model(large_tree(n, Shape::chain));
    const auto message = [&](const std::function<void()>& make) -> std::string {
        const LittleMemory little;
        try {
            make();
        } catch (const MemoryError& error) {
            return error.what();
        }
        return "(made)";
    };
    const auto contains = [](const std::string& text, const char* part) {
        return text.find(part) != std::string::npos;
    };
    const std::string branches = message([&] { BranchMatrix{model}; }), factor = message([&] { MetricFactor{model}; }),
                      symbols = message([&] { Christoffel{model}; }), curvature = message([&] { Curvature{model}; });
    CAPTURE(branches, factor, symbols, curvature);
    CHECK(contains(branches, "not enough memory for a matrix on the branches of 60000 bodies (28.8"));
    CHECK(contains(factor, "not enough memory for a matrix on the branches"));
    CHECK(contains(symbols, "not enough memory for the Christoffel symbols of 60000 bodies"));
    CHECK(contains(curvature, "not enough memory"));
}
