// In which direction motions become unstable, and what a search for limits says of what it does not follow: closed
// forms of a whirling disc, a top held upright by its spin, and an oscillating lag.
#include "solvers/campbell/detail/rotor_speed.hpp"
#include "solvers/stability/stability_limits.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/tree_tools.hpp"

#include <cmath>
#include <optional>

namespace cardan::testing::limit_direction_tests {

using namespace solvers;

namespace {

// Two coordinates in a plane, with mass, springs and dampers alike, and a force that is a function of both.
struct Plane {
    double mass = 1, stiffness = 1, damping = 0;
    std::function<void(double parameter, const ElementView& in, VectorOut Q)> force = {};
    RotorMap map = {};  // without parts
    std::optional<System> now = {};

    MachineFamily family() {
        return [this](double parameter) {
            Tree tree;
            ForceSet forces;
            FrameId at = Tree::base();
            for (const auto& [name, axis] :
                 {std::pair("x", Vec3(Vec3::UnitX())), std::pair("y", Vec3(Vec3::UnitY()))}) {
                BodySpec body = joint_spec(name, at, JointKind::prismatic, axis);
                const Placement back = body.placement.inverse();
                if (at != Tree::base()) body.inertia = RigidInertia{mass, Vec3::Zero(), Mat3::Zero()}.in(back);
                const BodyId id = tree.add_body(body);
                at = tree.add_frame(tree.frame_of(id), back, text("place ", name));
                forces.add_spring(text("spring ", name), id, stiffness, damping);
            }
            forces.add_element({.name = "force",
                                .points = {{Tree::base()}},
                                .evaluate = [this, parameter](const ElementView& in, ElementForces& out) {
                                    force(parameter, in, out.Q);
                                }});
            now.emplace(tree, forces);
            return CampbellCase{.system = &*now, .rotor = &map};
        };
    }
};

// m z'' + c z' + (k - i q) z = 0, z = x + i y: whirls forward from q = c sqrt(k / m) on.
Plane jeffcott() {
    return {.mass = 10, .stiffness = 1e6, .damping = 60, .force = [](double q, const ElementView& in, VectorOut Q) {
                Q(0) -= q * in.q(1);
                Q(1) += q * in.q(0);
            }};
}

// x'' + g y' + k x = 0, y'' - g x' - y = 0: lambda^4 + (g^2 + k - 1) lambda^2 - k = 0. Both springs negative: stable by
// the spin g. From k = 0 on there is a positive root.
Plane top(double sense) {
    constexpr double springs = 3, g = 4;
    return {.stiffness = springs, .force = [=](double parameter, const ElementView& in, VectorOut Q) {
                const double k = sense * parameter;
                Q(0) += (springs - k) * in.q(0) - g * in.qd(1);
                Q(1) += (springs + 1) * in.q(1) + g * in.qd(0);
            }};
}

}  // namespace

TEST_CASE("stability limits: of a machine without parts, a disc that whirls under cross-coupled stiffness",
          "[analytic]") {
    Plane disc = jeffcott();
    StabilityOptions options;
    options.modes.max_frequency_hz = 100;
    const StabilityLimits found = stability_limits(disc.family(), "cross-coupled stiffness, N/m", 1e3, 4e4, options);
    CHECK(found.note == "");
    REQUIRE(found.limits.size() == 1);
    const double natural = std::sqrt(disc.stiffness / disc.mass);
    CHECK(found.limits[0].kind == Instability::flutter);
    CHECK(found.limits[0].begins);
    CHECK(found.limits[0].parameter == Approx(disc.damping * natural).epsilon(1e-8));
    CHECK(found.limits[0].eigenvalue.imag() == Approx(natural).epsilon(1e-8));
    CHECK_THAT(found.limits[0].name, Catch::Contains("mode"));
    CHECK(found.diagram.branches.size() == 2);
}

TEST_CASE("stability limits: what lies beyond the largest frequency is told", "[analytic]") {
    Plane disc = jeffcott();
    const StabilityLimits none = stability_limits(disc.family(), "cross-coupled stiffness, N/m", 1e3, 4e4);
    CHECK(none.limits.empty());
    CHECK_THAT(none.note, Catch::Contains("the lowest has 50.3"));
    CHECK_THAT(none.note, Catch::Contains("a motion of 50.3") && Catch::Contains("grows at"));
    StabilityOptions options;
    options.modes.cancelled = [] { return true; };
    CHECK(stability_limits(disc.family(), "q", 1e3, 4e4, options).note == "cancelled before the first point");
}

TEST_CASE("stability limits: a top falls as one of two negative springs becomes positive; ceases the other way round",
          "[analytic]") {
    for (const double sense : {1.0, -1.0}) {
        Plane spinning = top(sense);
        const StabilityLimits found = stability_limits(spinning.family(), "stiffness, N/m", -1.3, 1.1, {.steps = 7});
        CAPTURE(sense, found.note);
        REQUIRE(found.limits.size() == 1);
        CHECK(found.limits[0].kind == Instability::divergence);
        CHECK(found.limits[0].begins == (sense > 0));
        CHECK(found.limits[0].parameter == Approx(0).margin(1e-7));
        CHECK(found.note.ends_with("diverges at stiffness, N/m -1.3 already") == (sense < 0));
    }
    Plane fallen = top(1);
    const StabilityLimits inside = stability_limits(fallen.family(), "stiffness, N/m", 0.5, 1);
    CHECK(inside.limits.empty());
    CHECK_THAT(inside.note, Catch::Contains("the machine diverges at stiffness, N/m 0.5 already"));
}

// s' = (-a + i w) s beside a mass on a spring, on which it hardly acts.
TEST_CASE("stability limits: an oscillating lag is named after its states, and left out of tables", "[analytic]") {
    constexpr double a = 3, w = 20, weak = 1e-3;
    std::optional<System> now;
    RotorMap map;
    const auto family = [&](double) {
        Tree tree;
        ForceSet forces;
        const Link link = add_joint(tree, {.name = "slide",
                                           .kind = JointKind::prismatic,
                                           .axis = Vec3::UnitX(),
                                           .inertia = {2, Vec3::Zero(), Mat3::Zero()}});
        forces.add_spring("spring", link.body, 50, 1);
        ForceElement lag{.name = "lag", .coordinates = {link.body}};
        for (const char* name : {"one", "two"})
            lag.states.push_back({.name = name, .unit = "N", .scale = 10, .part = "wake"});
        lag.evaluate = [](const ElementView& in, ElementForces& out) {
            out.Q(0) = weak * in.s(0);
            out.f(0) = -a * in.s(0) - w * in.s(1) + weak * in.q(0);
            out.f(1) = w * in.s(0) - a * in.s(1);
        };
        forces.add_element(lag);
        now.emplace(tree, forces);
        return CampbellCase{.system = &*now, .rotor = &map};
    };
    const StabilityLimits found = stability_limits(family, "nothing", 0, 1, {.steps = 2});
    const Branch& lag = found.diagram.branch("wake 1");
    CHECK(lag.of_states);
    CHECK(lag.family == "wake");
    const Mode& mode = found.diagram.mode(lag, 1)->mode;
    CHECK(mode.eigenvalue.real() == Approx(-a).epsilon(1e-6));
    CHECK(mode.eigenvalue.imag() == Approx(w).epsilon(1e-6));
    CHECK(found.diagram.branches.size() == 2);
    CHECK_FALSE(found.diagram.branch("mode").of_states);
    CHECK_THAT(table(found.diagram), !Catch::Contains("wake 1") && Catch::Contains("1 roots that are mostly states"));
    CHECK_THAT(table(found.diagram, true), Catch::Contains("wake 1"));
}

TEST_CASE("campbell: a frequency is in doubt from a damping ratio of 0.4 on", "[analytic]") {
    for (const double zeta : {0.39, 0.41}) {
        Plane disc{.mass = 2, .stiffness = 50, .damping = 2 * zeta * std::sqrt(2 * 50.0)};
        disc.force = [](double, const ElementView& in, VectorOut Q) { Q(1) -= 5000 * in.q(1); };
        const CampbellCase one = disc.family()(0);
        const Campbell diagram = campbell(*one.system, *one.rotor, {0.0}, {.max_frequency_hz = 100});
        REQUIRE(diagram.branches.size() == 2);
        CHECK(diagram.damping_ratio(diagram.branches[0], 0) == Approx(zeta).epsilon(1e-9));
        CHECK(diagram.branches[0].doubtful[0] == (zeta > heavy_damping));
        CHECK_FALSE(diagram.branches[1].doubtful[0]);
        CHECK((table(diagram).find("heavily damped (from 40 % on)") != std::string::npos) == (zeta > heavy_damping));
    }
}

// J p' + d p = 0 of a rotor's speed p, whose drag bends something on a spring: m u'' + k u + h p = 0. The bending has
// nearly all the energy; the left vector, (1, 0), has none of it.
TEST_CASE("campbell: a rotor that loses speed is told by participation, not by energy", "[analytic]") {
    constexpr double J = 5, d = 2, m = 1, k = 30, h = 400;
    SecondOrderSystem system;
    system.M = Vector(Eigen::Vector2d(J, m)).asDiagonal();
    system.C = (Matrix(2, 2) << d, 0, h, 0).finished();
    system.K = system.K_elastic = Vector(Eigen::Vector2d(0, k)).asDiagonal();
    const double lambda = -d / J, u = -h * lambda / (m * lambda * lambda + k);
    const Mode slow{.eigenvalue = lambda, .shape = Vector(Eigen::Vector2d(1, u)).cast<Complex>()};
    CHECK(k * u * u > 100 * J * lambda * lambda);
    CHECK(is_motion_of_speed(system, slow, 0));
    CHECK_FALSE(is_motion_of_speed(system, slow, 1));
    CHECK_FALSE(is_motion_of_speed(system, slow, -1));
    const Mode bending{.eigenvalue = Complex(0, std::sqrt(k / m)),
                       .shape = Vector(Eigen::Vector2d(0, 1)).cast<Complex>()};
    CHECK_FALSE(is_motion_of_speed(system, bending, 0));
}

// The torque follows the speed through many lags of either sign, as through the sections of a wake: (5 l + 5) (l + 0.3)
// + 0.4 = 0. At l = -0.856 the rotor has 5, the states have 22, but 1.3 of them together.
TEST_CASE("campbell: a rotor that loses speed is told through states that lag", "[property]") {
    constexpr int lags = 8;
    constexpr double J = 5, d = 5, m = 1, k = 30, h = 400;
    SecondOrderSystem system;
    system.M = Vector(Eigen::Vector2d(J, m)).asDiagonal();
    system.C = (Matrix(2, 2) << d, 0, h, 0).finished();
    system.K = system.K_elastic = Vector(Eigen::Vector2d(0, k)).asDiagonal();
    StateTerms& t = system.states;
    t.scales = Vector::Ones(lags);
    t.f_s = Matrix(-0.3 * Matrix::Identity(lags, lags));
    t.f_q = Matrix::Zero(lags, 2);
    t.f_qd = Matrix::Zero(lags, 2);
    t.Q_s = Matrix::Zero(2, lags);
    for (int i = 0; i < lags; ++i) {
        t.f_qd(i, 0) = 1;
        t.Q_s(0, i) = i % 2 == 0 ? 0.8 : -0.9;
    }
    int told = 0;
    for (const Mode& mode : modes(system)) {
        if (mode.is_state_motion() || mode.natural_hz() > 0.2) continue;
        CAPTURE(mode.eigenvalue, mode.state_share);
        CHECK(is_motion_of_speed(system, mode, 0));
        ++told;
    }
    CHECK(told == 1);
}

}  // namespace cardan::testing::limit_direction_tests
