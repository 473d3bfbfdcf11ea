// Change of chart: one set of bodies in other coordinates.
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/geometry/change_of_chart.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/tree_tools.hpp"

#include <array>

using namespace cardan;
using namespace cardan::testing;

namespace {

struct Charts {
    Model from, to;
};

// A floating body on translations and three rotations about the axes given, with a random tree on it; names of the
// rotations begin with those of the chart, all others are the same in every chart.
Tree floating(const std::string& chart, const std::array<int, 3>& axes, unsigned seed) {
    Random random(seed);
    Tree tree;
    FrameId at = tree.add_frame(Tree::base(), Placement::rotation(random_rotation(random)), "start");
    for (int axis = 0; axis < 3; ++axis)
        at = add_joint(tree, {text("translation ", axis), at, JointKind::prismatic, Vec3::Unit(axis)}).axes;
    for (int i = 0; i < 3; ++i) {
        const int axis = entry(axes, i);
        at = add_joint(tree, {text(chart, " rotation ", i), at, JointKind::revolute, Vec3::Unit(axis)}).axes;
    }
    const FrameId body = tree.add_frame(at, {}, "body");
    tree.weld(body, random_inertia(random));
    transplant(tree, body, random_tree(random, {.bodies = 5}));
    return tree;
}

Momentum momentum_of(const Model& model, const ChartState& s) {
    Workspace workspace(model);
    return momentum(kinematics(model, s.q, workspace), s.qd);
}

double energy_of(const Model& model, const ChartState& s) {
    Workspace workspace(model);
    return kinetic_energy(kinematics(model, s.q, workspace), s.qd);
}

Mat3 attitude(const Model& model, const ChartState& s) {
    Workspace workspace(model);
    return pose(kinematics(model, s.q, workspace), model.frame("body")).R;
}

ChartState random_motion(Random& random, const Model& model) {
    const Vector q = random_state(random, model.size(), 1.3);
    return {q, random_state(random, model.size())};
}

}  // namespace

TEST_CASE("change of chart: the bodies stay where they are and move as they did, and back again", "[property]") {
    Random random(71);
    for (unsigned seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        const Model xyz(floating("xyz", {0, 1, 2}, seed)), yxz(floating("yxz", {1, 0, 2}, seed));
        const ChartState s = random_motion(random, xyz);
        const ChartState other = change_of_chart(xyz, s, yxz, {"body"});
        REQUIRE((attitude(yxz, other) - attitude(xyz, s)).norm() < 1e-13);
        REQUIRE(energy_of(yxz, other) == Approx(energy_of(xyz, s)).epsilon(1e-10));
        const Momentum before = momentum_of(xyz, s), after = momentum_of(yxz, other);
        REQUIRE((after.linear - before.linear).norm() < 1e-10 * (1 + before.linear.norm()));
        REQUIRE((after.angular - before.angular).norm() < 1e-10 * (1 + before.angular.norm()));
        for (int i = 0; i < xyz.size(); ++i) {
            const std::string& name = xyz.coordinates()[i].name;
            if (name.find("rotation") != std::string::npos) continue;
            CHECK(other.q(yxz.index(name)) == s.q(i));
            CHECK(other.qd(yxz.index(name)) == s.qd(i));
        }
        // From where it was: the same angles, not those of the other branch or of another turn.
        const ChartState back = change_of_chart(yxz, other, xyz, {"body"}, s.q);
        CHECK((back.q - s.q).norm() < 1e-10);
        CHECK((back.qd - s.qd).norm() < 1e-8);
    }
}

TEST_CASE("change of chart: of any attitude Cardan's angles are found, singular ones but for their rates",
          "[property]") {
    Random random(72);
    const Model xyz(floating("xyz", {0, 1, 2}, 3)), yxz(floating("yxz", {1, 0, 2}, 3));
    for (int trial = 0; trial < 200; ++trial) {
        ChartState s = random_motion(random, xyz);
        for (int i = 0; i < 3; ++i) s.q(xyz.index(text("xyz rotation ", i))) = uniform(random, -10, 10);
        const ChartState other = change_of_chart(xyz, s, yxz, {"body"});
        REQUIRE((attitude(yxz, other) - attitude(xyz, s)).norm() < 1e-12);
    }
    // A quarter turn of the middle joint: the other chart is at its best there, and refuses to be left for this one.
    ChartState s = random_motion(random, yxz);
    s.q(yxz.index("yxz rotation 0")) = 0;
    s.q(yxz.index("yxz rotation 1")) = 0;
    s.q(yxz.index("yxz rotation 2")) = 0;
    const ChartState fine = change_of_chart(yxz, s, xyz, {"body"});
    CHECK((attitude(xyz, fine) - attitude(yxz, s)).norm() < 1e-13);
    s.q(yxz.index("yxz rotation 0")) = pi / 2;  // carries z onto x
    try {
        change_of_chart(yxz, s, xyz, {"body"});
        FAIL("not refused");
    } catch (const NumericalError& error) {
        const std::string message = error.what();
        CAPTURE(message);
        CHECK(message.find("singular at this state, 'xyz rotation") != std::string::npos);
    }
}

TEST_CASE("change of chart: several frames, and a chain whose frame hangs from known joints", "[property]") {
    // Two arms of three joints each with other orders of the axes, on a common turntable.
    Random random(73);
    const auto arms = [](const std::string& chart, const std::array<int, 3>& axes) {
        Tree tree;
        const Link table = add_joint(tree, {.name = "table", .axis = Vec3(0.2, 0.3, 0.9).normalized()});
        for (int arm = 0; arm < 2; ++arm) {
            FrameId at =
                tree.add_frame(table.axes, Placement::translation({1.0 + arm, 2, -40.0 * arm}), text("shoulder ", arm));
            for (int i = 0; i < 3; ++i) {
                const int axis = entry(axes, i);
                Joint joint{text(chart, " arm ", arm, " joint ", i), at, JointKind::revolute, Vec3::Unit(axis)};
                if (i == 2) joint.inertia = {2, {0, 0, 1}, Mat3::Identity()};
                at = add_joint(tree, joint).axes;
            }
            tree.add_frame(at, Placement::translation({0, 0, 2}), text("hand ", arm));
        }
        return Model(tree);
    };
    const Model a = arms("a", {0, 1, 2}), b = arms("b", {1, 0, 2});
    for (int trial = 0; trial < 20; ++trial) {
        const ChartState s = random_motion(random, a);
        const ChartState other = change_of_chart(a, s, b, {"hand 0", "hand 1"});
        CHECK(energy_of(b, other) == Approx(energy_of(a, s)).epsilon(1e-10));
        const Momentum before = momentum_of(a, s), after = momentum_of(b, other);
        CHECK((after.centre - before.centre).norm() < 1e-11);
        CHECK((after.linear - before.linear).norm() < 1e-9);
        CHECK((after.angular - before.angular).norm() < 1e-9);
    }
}

TEST_CASE("change of chart: the quality of three axes falls as sqrt(1 - |sin b|)", "[analytic]") {
    const Model model(floating("xyz", {0, 1, 2}, 5));
    std::vector<int> rotations;
    for (int i = 0; i < 3; ++i) rotations.push_back(model.index(text("xyz rotation ", i)));
    Random random(74);
    for (const double b : {0.0, 0.3, -1.2, 1.5, pi / 2}) {
        Vector q = random_state(random, model.size(), 3);
        q(rotations[1]) = b;
        CHECK(chart_quality(model, q, "body", rotations) ==
              Approx(std::sqrt(1 - std::abs(std::sin(b)))).epsilon(1e-12).margin(1e-8));
    }
}

TEST_CASE("change of chart: bad input is refused", "[property]") {
    const Model xyz(floating("xyz", {0, 1, 2}, 7)), yxz(floating("yxz", {1, 0, 2}, 7));
    const int n = xyz.size();
    const ChartState s{Vector::Constant(n, 0.3), Vector::Constant(n, 0.1)};
    check_refused(
        [&] {
            change_of_chart(xyz, {Vector::Zero(2), s.qd}, yxz, {"body"});
        },
        {"change of chart", "number of positions", "2", "one per coordinate"});
    check_refused([&] { change_of_chart(xyz, {s.q, Vector::Zero(1)}, yxz, {"body"}); }, {"number of rates", "1"});
    check_refused([&] { change_of_chart(xyz, s, yxz, {"body"}, Vector::Zero(3)); }, {"positions to begin at", "3"});
    check_refused([&] { change_of_chart(xyz, s, yxz, {"nobody"}); }, {"nobody"});
    check_refused([&] { change_of_chart(xyz, s, yxz, {}); }, {"number of frames", "0", "'yxz rotation 0'"});
    check_refused([&] { (void)chart_quality(xyz, s.q, "body", {}); }, {"number of coordinates", "0"});
    check_refused([&] { (void)chart_quality(xyz, s.q, "body", {n}); }, {"index of a coordinate", text(n)});
    check_refused([&] { (void)chart_quality(xyz, s.q, "start", {0}); }, {"'start'", "one that moves it"});
    // Two joints do not reach every attitude.
    Tree poor;
    FrameId at = Tree::base();
    for (const char* name : {"one", "two"})
        at = add_joint(poor, {name, at, JointKind::revolute, Vec3::UnitX(), {1, {1, 1, 0}, Mat3::Identity()}}).axes;
    poor.add_frame(at, {}, "body");
    try {
        change_of_chart(xyz, s, Model(poor), {"body"});
        FAIL("not refused");
    } catch (const NumericalError& error) {
        CHECK(std::string(error.what()).find("no position of the new coordinates ('one' ...)") != std::string::npos);
    }
}
