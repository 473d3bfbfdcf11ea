#include "mbs/base/units.hpp"
#include "solvers/algebra/dense.hpp"
#include "solvers/time/detail/tangent_factors.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/tree_tools.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

// A slider that is driven, a hinge, a slider and a hinge behind it, with springs, dampers, a load and gravity.
System arm() {
    Tree tree;
    ForceSet forces;
    FrameId at = Tree::base();
    const Vec3 axes[] = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
    for (int i = 0; i < 4; ++i) {
        const JointKind kind = i % 2 == 0 ? JointKind::prismatic : JointKind::revolute;
        const Mat3 J = Vec3(0.3, 0.2, 0.4).asDiagonal();
        const Link link = add_joint(tree, {.name = text("joint ", i),
                                           .inboard = at,
                                           .kind = kind,
                                           .axis = axes[i],
                                           .inertia = {2, {0.1, 0.2, -0.4}, J}});
        forces.add_spring(text("spring ", i), link.body, 40 + i, 3);
        at = tree.add_frame(link.axes, Placement::translation({0.2, 0.1, -0.7}), text("end ", i));
    }
    forces.add_wrench({"load", at, {{3, -2, 1}, {0.5, 0, 0.2}}, WrenchAxes::frame});
    forces.set_gravity({0, 0, -units::standard_gravity});
    return {tree, forces};
}

EquationsOfMotion driven_arm(const System& system) {
    Vector q(4), qd(4);
    q << 0, 0.3, 0.1, -0.5;
    qd << 0, 1, -0.7, 2;
    return {system, {{0, Motion::harmonic(0.1, 0.5, 2)}}, 0.3, q, qd};
}

}  // namespace

TEST_CASE("equations of motion: the Jacobian and the tangent are the derivatives", "[solvers][integrate][property]") {
    const System system = arm();
    EquationsOfMotion equations = driven_arm(system);
    const int m = equations.size();
    REQUIRE(m == 3);
    Vector x(2 * m), qdd(m), plus(m), minus(m);
    x << 0.3, 0.1, -0.5, 1, -0.7, 2;
    REQUIRE(equations.linearise(0.3, x.data()));
    Matrix K_q(m, m), K_qd(m, m), g(m, m);
    equations.tangent(0, 0, 1, K_q);
    equations.tangent(0, 1, 0, K_qd);
    equations.tangent(1, 0, 0, g);
    Matrix by_q = -K_q, by_qd = -K_qd, factors = g;
    solve_in_place(factors, by_q);
    factors = g;
    solve_in_place(factors, by_qd);
    REQUIRE(equations.accelerations(0.3, x.data(), qdd.data()));
    const Vector at = qdd;
    REQUIRE(equations.residual(0.3, x.data(), at.data(), plus.data()));
    CHECK(plus.norm() < 1e-12 * 100);  // forces of some 100 N
    Matrix again(m, m);
    equations.linearise_residual();
    equations.tangent(2, 3, 5, again);
    CHECK((again - (2 * g + 3 * K_qd + 5 * K_q)).norm() < 1e-13 * again.norm());
    constexpr double h = 1e-5;
    for (int i = 0; i < 2 * m; ++i) {
        Vector up = x, down = x;
        up(i) += h;
        down(i) -= h;
        CAPTURE(equations.name_of(i));
        CHECK(equations.accelerations(0.3, up.data(), plus.data()));
        CHECK(equations.accelerations(0.3, down.data(), minus.data()));
        const Vector jacobian = i < m ? by_q.col(i) : by_qd.col(i - m);
        CHECK((jacobian - (plus - minus) / (2 * h)).norm() < 1e-7 * (1 + jacobian.norm()));
        CHECK(equations.residual(0.3, up.data(), at.data(), plus.data()));
        CHECK(equations.residual(0.3, down.data(), at.data(), minus.data()));
        const Vector tangent = i < m ? K_q.col(i) : K_qd.col(i - m);
        CHECK((tangent - (plus - minus) / (2 * h)).norm() < 1e-7 * (1 + tangent.norm()));
    }
}

TEST_CASE("equations of motion: factors on branches, and of full matrices where a spring joins two branches",
          "[solvers][integrate][property]") {
    for (const bool joined : {false, true}) {
        Random random(7);
        const Tree tree = random_tree(random, {.bodies = 14});
        ForceSet forces;
        forces.set_gravity({0, 0, -units::standard_gravity});
        const Model model(tree);
        int left = -1, right = -1;
        for (int a = 1; a < model.size() && left < 0; ++a)
            for (int b = a + 1; b < model.size(); ++b)
                if (!model.precedes(a, b)) left = a, right = b;
        REQUIRE(left >= 0);
        const auto body = [&](int index) {
            BodyId id{0};
            while (model.index(id) != index) ++id.index;
            return id;
        };
        for (int a = 0; a < model.size(); ++a) forces.add_spring(text("spring ", a), body(a), 50, 2);
        if (joined)
            forces.add_law({"joins", {body(left), body(right)}, 30 * Matrix::Ones(2, 2), 4 * Matrix::Ones(2, 2), {}});
        const System system(tree, forces);
        const int n = model.size();
        const Vector q = random_state(random, n), qd = random_state(random, n);
        EquationsOfMotion equations(system, {{2, Motion::constant_rate(q(2), qd(2))}}, 0, q, qd);
        const int m = equations.size();
        Vector x(2 * m);
        for (int i = 0; i < m; ++i)
            x(i) = q(entry(equations.unknowns(), i)), x(m + i) = qd(entry(equations.unknowns(), i));
        REQUIRE(equations.linearise(0, x.data()));
        BranchMatrix on_branches(system.model);
        CHECK(equations.tangent_on_branches(1, 0.1, 0.01, on_branches) == !joined);
        TangentFactors factors(equations);
        factors.form({.qdd = 1, .qd = 0.1, .q = 0.01, .s_rate = 1, .s = 0});
        Matrix K(m, m), g(m, m), S(m, m);
        equations.tangent(1, 0.1, 0.01, K);
        equations.tangent(1, 0, 0, g);
        equations.tangent(0, 0, 1, S);
        const Vector b = random_state(random, m);
        Vector solution = b, product(m);
        factors.solve(solution);
        CAPTURE(joined);
        CHECK((K * solution - b).norm() < 1e-13 * (b.norm() + K.norm() * solution.norm()));
        equations.multiply_metric(b, product);
        CHECK((product - g * b).norm() < 1e-14 * g.norm() * b.norm());
        equations.subtract_stiffness(0.5, b, product);
        CHECK((product - (g * b - 0.5 * S * b)).norm() < 1e-14 * (g.norm() + S.norm()) * b.norm());
    }
}

TEST_CASE("equations of motion: the power of all forces is the rate of kinetic energy",
          "[solvers][integrate][property]") {
    const System system = arm();
    EquationsOfMotion equations = driven_arm(system);
    equations.set_piece(0.3);
    const int m = equations.size();
    Vector x(2 * m), up(2 * m), down(2 * m);
    x << 0.3, 0.1, -0.5, 1, -0.7, 2;
    DynamicState state, after, before;
    REQUIRE(equations.complete(0.3, x.data(), state));
    Powers power;
    REQUIRE(equations.powers(0.3, x.data(), power));
    constexpr double h = 1e-5;
    Vector qdd(m);
    REQUIRE(equations.accelerations(0.3, x.data(), qdd.data()));
    up << x.head(m) + h * x.tail(m), x.tail(m) + h * qdd;
    down << x.head(m) - h * x.tail(m), x.tail(m) - h * qdd;
    REQUIRE(equations.complete(0.3 + h, up.data(), after));
    REQUIRE(equations.complete(0.3 - h, down.data(), before));
    const double rate = (equations.kinetic_energy(after) - equations.kinetic_energy(before)) / (2 * h);
    CHECK(rate == Approx(power.forces + power.drives).epsilon(1e-6));
    const double damper_power = 3 * state.qd.squaredNorm();
    CHECK(power.dissipation == Approx(damper_power));
}

TEST_CASE("equations of motion: what is not finite is named", "[solvers][integrate][property]") {
    const System system = arm();
    EquationsOfMotion equations = driven_arm(system);
    Vector x = Vector::Zero(6), qdd(3);
    x(4) = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(equations.accelerations(0.3, x.data(), qdd.data()));
    CHECK(equations.problem().find("rate of 'joint 2'") != std::string::npos);
}
