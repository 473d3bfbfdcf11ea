// Buckling and flutter of few degrees of freedom against closed forms.
#include "mbs/base/error.hpp"
#include "solvers/equilibrium/buckling.hpp"
#include "solvers/equilibrium/load_stability.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/tree_tools.hpp"

#include <cmath>
#include <limits>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

// Two weightless bars of length l on springs k (dampers c), upright along z, turning about y; point masses 2m at the
// knee and m at the tip, and a force P along the second bar or along -z at the tip (Ziegler's double pendulum).
struct DoublePendulum {
    double m = 1.3, length = 0.7, k = 5, damping = 0;
    Vec3 force = {0, 0, -1}, gravity = Vec3::Zero();
    WrenchAxes axes = WrenchAxes::base;

    System system() const {
        Tree tree;
        ForceSet forces;
        const Vec3 up(0, 0, length);
        const Link first = add_joint(tree, {.name = "foot", .axis = Vec3::UnitY(), .inertia = {2 * m, up}});
        const FrameId knee = tree.add_frame(first.axes, Placement::translation(up), "knee place");
        const Link second =
            add_joint(tree, {.name = "knee", .inboard = knee, .axis = Vec3::UnitY(), .inertia = {m, up}});
        const FrameId tip = tree.add_frame(second.axes, Placement::translation(up), "tip");
        forces.add_spring("foot", first.body, k, damping);
        forces.add_spring("knee", second.body, k, damping);
        forces.add_wrench({"tip force", tip, {force, Vec3::Zero()}, axes});
        forces.set_gravity(gravity);
        return System(tree, forces);
    }
};

}  // namespace

TEST_CASE("linear buckling: a double pendulum on springs buckles at (3 -+ sqrt 5)/2 k/l", "[analytic]") {
    // In absolute angles: k [2 -1; -1 1] x = P l x.
    const DoublePendulum pendulum;
    const auto found = linear_buckling(pendulum.system(), {.count = 5});
    REQUIRE(found.size() == 2);
    const double unit = pendulum.k / pendulum.length, root = std::sqrt(5.0);
    CHECK(found[0].factor == Approx((3 - root) / 2 * unit).epsilon(1e-13));
    CHECK(found[1].factor == Approx((3 + root) / 2 * unit).epsilon(1e-13));
    // Absolute angles (1, (1 + sqrt 5)/2), so the knee turns by (sqrt 5 - 1)/2 of the foot.
    CHECK(found[0].shape(0) == Approx(1));
    CHECK(found[0].shape(1) == Approx((root - 1) / 2).epsilon(1e-12));
    CHECK(linear_buckling(pendulum.system()).size() == 1);
}

TEST_CASE("linear buckling: gravity is a load or a part of the structure", "[analytic]") {
    // Absolute angles: k [2 -1; -1 1] - P l 1 - g m l diag(3, 1).
    DoublePendulum pendulum;
    pendulum.gravity = {0, 0, -0.4};
    const double k = pendulum.k, weight = 0.4 * pendulum.m * pendulum.length, P = pendulum.length;
    const auto min_root = [](double a, double b, double c) { return 2 * c / (-b + std::sqrt(b * b - 4 * a * c)); };
    // det(K - factor B) = 0, B diagonal (b1, b2): factor^2 b1 b2 - factor (k1 b2 + k2 b1) + (k1 k2 - k^2).
    const auto expected = [&](double k1, double k2, double b1, double b2) {
        return min_root(b1 * b2, -(k1 * b2 + k2 * b1), k1 * k2 - k * k);
    };
    CHECK(linear_buckling(pendulum.system())[0].factor ==
          Approx(expected(2 * k, k, P + 3 * weight, P + weight)).epsilon(1e-12));
    CHECK(linear_buckling(pendulum.system(), {.gravity = false})[0].factor ==
          Approx(expected(2 * k - 3 * weight, k - weight, P, P)).epsilon(1e-12));
}

TEST_CASE("linear buckling: pulling loads have no positive factor", "[analytic]") {
    DoublePendulum pendulum;
    pendulum.force = {0, 0, 1};
    CHECK(linear_buckling(pendulum.system()).empty());
    pendulum.force = Vec3::Zero();
    CHECK(linear_buckling(pendulum.system()).empty());
}

TEST_CASE("linear buckling about a bent state: the stiffness of the loads is taken there", "[analytic]") {
    // One bar at the angle q: k - factor P l cos q; the second one is locked by a stiff spring.
    Tree tree;
    ForceSet forces;
    const Link bar = add_joint(tree, {.name = "bar", .axis = Vec3::UnitY(), .inertia = {1, {0, 0, 2}}});
    const FrameId tip = tree.add_frame(bar.axes, Placement::translation({0, 0, 2}), "tip");
    forces.add_spring("spring", bar.body, 6);
    forces.add_wrench({"load", tip, {{0, 0, -1}, Vec3::Zero()}, WrenchAxes::base});
    const System system(tree, forces);
    for (const double q : {0.0, 0.4, -1.0})
        CHECK(linear_buckling(system, {.at = Vector::Constant(1, q)})[0].factor ==
              Approx(6 / (2 * std::cos(q))).epsilon(1e-13));
    CHECK(linear_buckling(system, {.at = Vector::Constant(1, 2.0)}).empty());
}

TEST_CASE("linear buckling refuses loads without potential, bad counts and states, and unstable structures",
          "[property]") {
    DoublePendulum pendulum;
    const System dead = pendulum.system();
    check_refused([&] { (void)linear_buckling(dead, {.count = 0}); }, {"number of factors = 0", ">= 1"});
    check_refused([&] { (void)linear_buckling(dead, {.at = Vector::Zero(3)}); }, {"size of the state = 3", "2"});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    check_refused([&] { (void)linear_buckling(dead, {.at = Vector::Constant(2, nan)}); }, {"finite"});
    pendulum.axes = WrenchAxes::frame;
    check_refused([&] { (void)linear_buckling(pendulum.system()); },
                  {"skew part of the load stiffness", "no potential", "dynamic criterion", "load_stability()"});
    pendulum.axes = WrenchAxes::base;
    pendulum.gravity = {0, 0, -100};
    CHECK_THROWS_AS(linear_buckling(pendulum.system(), {.gravity = false}), NumericalError);
    CHECK(linear_buckling(pendulum.system()).size() == 1);
}

TEST_CASE(
    "Ziegler's double pendulum flutters at (7/2 - sqrt 2) k/l without damping, at 41/28 k/l + c^2 / (2 m l^3) "
    "with",
    "[analytic]") {
    // Ziegler, Ing.-Archiv 20, 1952, 49-56; Bolotin 1963, section 2.2 (masses 2m and m, equal dampers).
    DoublePendulum pendulum;
    pendulum.axes = WrenchAxes::frame;
    const double unit = pendulum.k / pendulum.length;
    const LoadStability undamped = load_stability(pendulum.system(), {.to = 5 * unit});
    CHECK(undamped.converged);
    CHECK(undamped.kind == Instability::flutter);
    CHECK(undamped.factor == Approx((3.5 - std::sqrt(2.0)) * unit).epsilon(1e-9));
    for (const double c : {0.05, 0.5}) {
        pendulum.damping = c;
        const LoadStability damped = load_stability(pendulum.system(), {.to = 5 * unit, .growth = 1e-10});
        const double expected = 41. / 28 * unit + c * c / (2 * pendulum.m * std::pow(pendulum.length, 3));
        CHECK(damped.kind == Instability::flutter);
        CHECK(damped.factor == Approx(expected).epsilon(1e-8));
    }
}

TEST_CASE("load stability: divergence, stability to the end, and an instability at the start", "[analytic]") {
    const DoublePendulum pendulum;
    const System system = pendulum.system();
    const double critical = (3 - std::sqrt(5.0)) / 2 * pendulum.k / pendulum.length;
    const LoadStability found = load_stability(system, {.to = 3 * critical, .steps = 7});
    CHECK(found.converged);
    CHECK(found.kind == Instability::divergence);
    CHECK(found.factor == Approx(critical).epsilon(1e-7));
    CHECK(found.eigenvalue.real() > 0);
    CHECK(found.message.empty());
    CHECK(found.points.size() == 4);

    const LoadStability stable = load_stability(system, {.to = 0.9 * critical, .steps = 5});
    CHECK(stable.converged);
    CHECK(stable.kind == Instability::none);
    CHECK(stable.factor == 0.9 * critical);
    CHECK(stable.stable_factor == stable.factor);
    CHECK(stable.points.size() == 6);

    const LoadStability late = load_stability(system, {.from = 1.1 * critical, .to = 2 * critical, .steps = 5});
    CHECK(late.converged);
    CHECK(late.kind == Instability::divergence);
    CHECK(late.factor == 1.1 * critical);
    CHECK(late.stable_factor == late.factor);
    CHECK(late.message.empty());
    CHECK(late.note.find("already at the first load factor") != std::string::npos);
}

TEST_CASE("load stability: where no equilibrium exists the scan ends and says so", "[analytic]") {
    // m g l sin q = M up to M = m g l; gravity stays.
    Tree tree;
    ForceSet forces;
    const Link link = add_joint(tree, {.name = "hinge", .axis = Vec3::UnitY(), .inertia = {2, {0, 0, -1.5}}});
    forces.set_gravity({0, 0, -10});
    forces.add_wrench({"moment", link.axes, {Vec3::Zero(), {0, 30, 0}}, WrenchAxes::base});
    const LoadStability found = load_stability(System(tree, forces), {.to = 1.2, .steps = 12, .gravity = false});
    CHECK_FALSE(found.converged);
    CHECK(found.kind == Instability::none);
    CHECK(found.stable_factor >= 0.9);
    CHECK(found.stable_factor < 1.05);
    CHECK(found.message.find("no equilibrium at load factor 1") != std::string::npos);
}

TEST_CASE("load stability refuses bounds that are not finite and rising, and bad numbers", "[property]") {
    const System system = DoublePendulum{}.system();
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    check_refused([&] { (void)load_stability(system, {.from = nan}); }, {"load factors from, to", "nan", "finite"});
    check_refused([&] { (void)load_stability(system, {.to = inf}); }, {"load factors from, to", "inf"});
    check_refused([&] { (void)load_stability(system, {.from = 1, .to = 1}); }, {"load factors from, to = 1, 1"});
    check_refused([&] { (void)load_stability(system, {.steps = 0}); }, {"number of steps = 0", ">= 1"});
    check_refused([&] { (void)load_stability(system, {.tolerance = 0}); }, {"tolerance", "> 0"});
    check_refused([&] { (void)load_stability(system, {.growth = nan}); }, {"growth = nan", "> 0"});
}
