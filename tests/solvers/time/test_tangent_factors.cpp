// Newton's matrix of an implicit step with states, by parts, against the full matrix.
#include "mbs/base/error.hpp"
#include "solvers/time/detail/tangent_factors.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/tree_tools.hpp"

#include <array>

namespace cardan::testing::tangent_with_states {

using namespace solvers;

TEST_CASE("states in time: the bordered factors solve what the full matrix does", "[solvers][integrate][property]") {
    // States that couple hinges which are not on one branch, one of them driven, and states on one branch, of two
    // elements: these are eliminated first.
    Tree tree;
    ForceSet set;
    std::vector<BodyId> bodies;
    const Mat3 J = Vec3(0.3, 0.2, 0.4).asDiagonal();
    const std::array<Vec3, 5> axes{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitX()};
    FrameId root = Tree::base();
    for (int i = 0; i < 5; ++i) {
        const Link link = add_joint(tree, {.name = text("hinge ", i),
                                           .inboard = i == 2 ? Tree::base() : root,
                                           .axis = axes.at(static_cast<std::size_t>(i)),
                                           .inertia = {2, {0.1, 0.2, -0.4}, J},
                                           .role = i == 1 ? CoordinateRole::prescribed : CoordinateRole::free});
        bodies.push_back(link.body);
        root = tree.add_frame(link.axes, Placement::translation({0.2, 0.1, -0.7}), text("end ", i));
        set.add_spring(text("spring ", i), link.body, 40 + i, 3);
    }
    ForceElement bridge{.name = "bridge",
                        .states = {{.name = "a", .unit = "1", .scale = 1}, {.name = "b", .unit = "1", .scale = 1}},
                        .coordinates = {bodies[0], bodies[1], bodies[4]}};
    bridge.evaluate = [](const ElementView& in, ElementForces& out) {
        out.Q << in.s(0) * in.q(2), in.s(1), -in.s(0) * in.s(1);
        out.f << -in.s(0) + 2 * in.qd(0) + std::sin(in.q(2)), in.s(0) * in.q(0) - 0.3 * in.s(1) + in.qd(2);
    };
    set.add_element(bridge);
    ForceElement branch{.name = "branch",
                        .states = {{.name = "c", .unit = "1", .scale = 1}, {.name = "d", .unit = "1", .scale = 1}},
                        .coordinates = {bodies[4], bodies[2]}};
    branch.evaluate = [](const ElementView& in, ElementForces& out) {
        out.Q << 7 * in.s(0) * in.q(1), 4 * in.s(1);
        out.f << 5 * in.qd(0) * in.s(1) - 2 * in.s(0), 3 * std::sin(in.q(1)) + in.s(0);
    };
    set.add_element(branch);
    ForceElement reader{.name = "reader",
                        .states = {{.name = "e", .unit = "1", .scale = 1}},
                        .coordinates = {bodies[3]},
                        .reads = {"d"}};
    reader.evaluate = [](const ElementView& in, ElementForces& out) {
        out.Q(0) = 6 * in.s(0) * in.others(0);
        out.f(0) = in.others(0) - 4 * in.s(0) + 8 * in.q(0);
    };
    set.add_element(reader);
    const System system(tree, set);
    const std::vector<StateGroup>& groups = system.forces.state_groups();
    REQUIRE(groups.size() == 2);
    CHECK(groups[0].states == std::vector{0, 1});
    CHECK(groups[1].states == std::vector{2, 3, 4});
    CHECK(groups[1].coordinates ==
          std::vector{system.model.index("hinge 2"), system.model.index("hinge 3"), system.model.index("hinge 4")});
    EquationsOfMotion equations(system, {}, 0, Vector::Constant(5, 0.2), Vector::Constant(5, -0.3));
    const int n = equations.size(), m = equations.states();
    REQUIRE(n == 4);
    Vector x(equations.length());
    x << 0.1, -0.2, 0.3, 0.4, 1, -0.7, 0.2, 0.5, 0.6, -0.8, 0.3, -0.4, 0.9;
    REQUIRE(equations.linearise(0, x.data()));
    for (const bool on_branches : {true, false}) {
        const double c = 0.07;
        Matrix K(n, n), full(n + m, n + m);
        equations.tangent(1, c, on_branches ? c * c : 0.1, K);
        const StateDerivatives& d = equations.state_derivatives();
        full.topLeftCorner(n, n) = K;
        for (int i = 0; i < n; ++i) {
            const int at = equations.unknowns()[static_cast<std::size_t>(i)];
            full.row(i).tail(m) = -c * d.Q_s.row(at);
            full.col(i).tail(m) = -c * d.f_qd.col(at) - (on_branches ? c * c : 0.1) * d.f_q.col(at);
        }
        full.bottomRightCorner(m, m) = 1.5 * Matrix::Identity(m, m) - c * d.f_s;
        TangentFactors factors(equations);
        factors.form({.qdd = 1, .qd = c, .q = on_branches ? c * c : 0.1, .s_rate = 1.5, .s = c});
        const Vector right = Vector::LinSpaced(n + m, -1, 2);
        Vector found = right;
        factors.solve(found);
        CHECK((full * found - right).norm() < 1e-12);
    }
}

}  // namespace cardan::testing::tangent_with_states
