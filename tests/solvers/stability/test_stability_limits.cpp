// Where motions begin to grow over a parameter, against closed forms: follower and dead loads on a column, damping that
// turns with a shaft, a spring with a lag, blades with negative damping; what is followed, noted and refused.
#include "mbs/base/error.hpp"
#include "solvers/stability/stability_limits.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <set>

namespace cardan::testing::stability_limit_tests {

using namespace solvers;

namespace {

// A system that is made again for every value of a parameter.
struct Remade {
    std::function<System(double)> make;
    RotorMap map = {};
    std::optional<System> now = {};

    MachineFamily family() {
        return [this](double parameter) {
            now.emplace(make(parameter));
            return CampbellCase{.system = &*now, .rotor = &map};
        };
    }
};

// Two links of length 1 m with 2 kg between them and 1 kg at the end, springs of 1 N m/rad at the joints, under a load
// P along the column. At rest along x, turning about y.                      [Ziegler, Ingenieur-Archiv 20 (1952)
// 49-56]
System ziegler_column(double P, WrenchAxes axes) {
    Tree tree;
    ForceSet forces;
    FrameId at = Tree::base();
    for (const double mass : {2.0, 1.0}) {
        const Link link = add_joint(tree, {.name = text("joint ", mass),
                                           .inboard = at,
                                           .axis = Vec3::UnitY(),
                                           .inertia = {mass, {1, 0, 0}, Mat3::Zero()}});
        forces.add_spring(text("spring ", mass), link.body, 1);
        at = tree.add_frame(link.axes, Placement::translation({1, 0, 0}), text("end ", mass));
    }
    forces.add_wrench({.name = "load", .frame = at, .wrench = {Vec3(-P, 0, 0), Vec3::Zero()}, .axes = axes});
    return {tree, forces};
}

Remade loaded_column(WrenchAxes axes) {
    Remade out{[axes](double P) { return ziegler_column(P, axes); }};
    out.map.machine = "column";
    out.map.parts = {{"", Tree::base(), {}, {"", "column", ""}}};
    return out;
}

// A mass on a spring whose force is raised by g times the deflection, behind a lag tau:
//     (m s^2 + k) (1 + tau s) - g = 0.
constexpr double lag_mass = 2, lag_stiffness = 50, lag_time = 0.3;
System lagging_spring(double g) {
    Tree tree;
    ForceSet forces;
    const Link link = add_joint(tree, {.name = "slide",
                                       .kind = JointKind::prismatic,
                                       .axis = Vec3::UnitX(),
                                       .inertia = {lag_mass, Vec3::Zero(), Mat3::Zero()}});
    forces.add_spring("spring", link.body, lag_stiffness);
    ForceElement lag{
        .name = "lag", .states = {{.name = "lagging force", .unit = "N", .scale = 10}}, .coordinates = {link.body}};
    lag.evaluate = [g](const ElementView& in, ElementForces& out) {
        out.Q(0) = in.s(0);
        out.f(0) = (g * in.q(0) - in.s(0)) / lag_time;
    };
    forces.add_element(lag);
    return {tree, forces};
}

Remade lagging_family() {
    Remade out{lagging_spring};
    out.map.machine = "lagging spring";
    out.map.parts = {{"", Tree::base(), {"slide", "", ""}, {}}};
    return out;
}

// Blades with dampers 2 N m s/rad at their flap hinges, less a parameter.
struct DampedRotor {
    std::size_t blades = 3;
    std::optional<SmallRotor> now = {};

    MachineFamily family(double speed) {
        return [this, speed](double less) {
            SmallRotorSpec spec{.stiffness = std::vector<double>(blades, 2000.0), .damping = 2};
            spec.more = [less](ForceSet& forces, const std::vector<std::vector<BodyId>>& bodies) {
                for (const std::vector<BodyId>& blade : bodies) {
                    ForceElement driven{.name = text("driven ", blade[0].index),
                                        .states = {{.name = text("unused ", blade[0].index),
                                                    .unit = "1",
                                                    .scale = 1,
                                                    .part = "blade",
                                                    .blade = static_cast<int>(&blade - bodies.data()) + 1}},
                                        .coordinates = {blade[0]}};
                    driven.evaluate = [less](const ElementView& in, ElementForces& out) {
                        out.Q(0) = less * in.qd(0);
                        out.f(0) = -in.s(0);
                    };
                    forces.add_element(driven);
                }
            };
            now.emplace(small_rotor(spec));
            return CampbellCase{.system = &now->system, .rotor = &now->map, .rotor_speed = speed};
        };
    }
    // In the rotating frame, rad/s: w^2 = k / (m l^2) + Omega^2 (1 + e / l).
    static double flap(double Omega) { return std::sqrt(2000.0 / (3 * 16) + Omega * Omega * (1 + 0.5 / 4)); }
};

}  // namespace

TEST_CASE("stability limits: a column under a follower load flutters at Ziegler's load", "[analytic]") {
    Remade column = loaded_column(WrenchAxes::frame);
    // Undamped, the frequencies meet: P = 7/2 - sqrt 2, omega^4 = 1/2.
    for (const int steps : {3, 20}) {
        StabilityOptions options;
        options.steps = steps;
        const StabilityLimits found = stability_limits(column.family(), "load, N", 0.1, 4, options);
        CAPTURE(found.note);
        REQUIRE(found.limits.size() == 1);
        CHECK(found.limits[0].kind == Instability::flutter);
        CHECK(found.limits[0].begins);
        CHECK(found.limits[0].parameter == Approx(3.5 - std::numbers::sqrt2).epsilon(1e-8));
        // Of a double root: the square root of what the parameter is off.
        CHECK(found.limits[0].eigenvalue.imag() == Approx(std::pow(0.5, 0.25)).epsilon(5e-5));
        CHECK(found.limits[0].name.ends_with("column"));
        CHECK(found.diagram.complete);
        CHECK(found.diagram.parameter == "load, N");
        CHECK(found.diagram.parameters.back() == 4);
        CHECK(found.diagram.points.size() == found.diagram.parameters.size());
    }
}

TEST_CASE("stability limits: a column under a dead load diverges at both loads of Euler", "[analytic]") {
    Remade column = loaded_column(WrenchAxes::base);
    const StabilityLimits found = stability_limits(column.family(), "load, N", 0, 4);
    CHECK(found.note == "");
    REQUIRE(found.limits.size() == 2);
    // (2 - P) (1 - P) - 1 = 0.
    const double root = std::sqrt(5.0);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(found.limits[i].kind == Instability::divergence);
        CHECK(found.limits[i].begins);
        CHECK(found.limits[i].parameter == Approx((i == 0 ? 3 - root : 3 + root) / 2).epsilon(1e-8));
        CHECK(found.limits[i].eigenvalue == 0.0);
    }
    CHECK(found.limits[0].name == "1st column");
    CHECK(found.first(Instability::divergence) == &found.limits[0]);
    CHECK(found.first(Instability::flutter) == nullptr);
}

TEST_CASE("stability limits: a spring with a lag ceases to flutter without gain, and diverges when it is gone",
          "[analytic]") {
    Remade spring = lagging_family();
    const StabilityLimits found = stability_limits(spring.family(), "gain, N/m", -21, 77);
    REQUIRE(found.limits.size() == 2);
    const StabilityLimit &flutter = found.limits[0], &divergence = found.limits[1];
    CHECK(flutter.kind == Instability::flutter);
    CHECK_FALSE(flutter.begins);
    CHECK(flutter.parameter == Approx(0).margin(1e-5));  // growth of 1e-8 counts as none
    CHECK(flutter.eigenvalue.imag() == Approx(std::sqrt(lag_stiffness / lag_mass)).epsilon(1e-6));
    CHECK(divergence.kind == Instability::divergence);
    CHECK(divergence.begins);
    CHECK(divergence.parameter == Approx(lag_stiffness).epsilon(1e-8));
    CHECK(divergence.name == "slide");
    CHECK(found.note == "slide grows at gain, N/m -21 already");
    CHECK(found.first(Instability::flutter) == nullptr);
}

TEST_CASE("stability limits: blades whose damping is taken away, in multi-blade coordinates and by Floquet's theory",
          "[analytic]") {
    const double Omega = 2;
    for (const std::size_t blades : {std::size_t{2}, std::size_t{3}}) {
        DampedRotor rotor{blades};
        StabilityOptions options;
        options.modes.spin = RotorSpin::prescribed;
        options.steps = 3;
        options.growth = 1e-12;  // as little as rounding is here
        const StabilityLimits found = stability_limits(rotor.family(Omega), "damping, N m s/rad", 0.5, 2.9, options);
        CAPTURE(blades, found.note, found.diagram.method);
        REQUIRE(found.limits.size() == blades);
        std::set<std::string> names;
        for (const StabilityLimit& limit : found.limits) {
            names.insert(limit.name);
            CHECK(limit.kind == Instability::flutter);
            CHECK(limit.parameter == Approx(2).epsilon(1e-6));
            CHECK(limit.rotor_speed == Omega);
            const double shift = limit.name.ends_with("(forward)")    ? Omega
                                 : limit.name.ends_with("(backward)") ? -Omega
                                                                      : 0;
            CHECK(limit.eigenvalue.imag() == Approx(DampedRotor::flap(Omega) + shift).epsilon(1e-7));
            CHECK_FALSE(limit.doubtful);
        }
        CHECK(names == (blades == 2 ? std::set<std::string>{"blade flap (antisymmetric)", "blade flap (symmetric)"}
                                    : std::set<std::string>{"blade flap (backward)", "blade flap (collective)",
                                                            "blade flap (forward)"}));
    }
}

TEST_CASE("stability limits: damping that turns with a shaft makes it whirl from a rotor speed on", "[analytic]") {
    // m z'' + (c_i + c_e) z' + (k - i Omega c_i) z = 0 in the fixed frame: from Omega = sqrt(k / m) (1 + c_e / c_i) on.
    const double m = 5, k = 800, inside = 3, outside = 2;
    Tree tree;
    ForceSet forces;
    const Link spin = add_joint(tree, {.name = "spin", .axis = Vec3::UnitX()});
    FrameId at = spin.axes;
    std::vector<BodyId> pair;
    for (const Vec3& axis : {Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())}) {
        BodySpec body = joint_spec(text("deflection ", pair.size()), at, JointKind::prismatic, axis);
        const Placement back = body.placement.inverse();
        if (pair.size() == 1) body.inertia = RigidInertia{m, Vec3::Zero(), Vec3(3, 2, 2).asDiagonal()}.in(back);
        body.coordinate.part = "shaft";
        pair.push_back(tree.add_body(body));
        at = tree.add_frame(tree.frame_of(pair.back()), back, text("place ", pair.size()));
        forces.add_spring(text("spring ", pair.size()), pair.back(), k, inside);
    }
    const Model model(tree);
    const int y = model.index(pair[0]), z = model.index(pair[1]), turns = model.index(spin.body);
    forces.add_element(
        {.name = "bath", .points = {{Tree::base()}}, .evaluate = [=](const ElementView& in, ElementForces& out) {
             out.Q(y) -= outside * (in.qd(y) - in.qd(turns) * in.q(z));
             out.Q(z) -= outside * (in.qd(z) + in.qd(turns) * in.q(y));
         }});
    const System system(tree, forces);
    RotorMap map;
    map.machine = "shaft";
    map.spin = turns;
    map.hub = spin.axes;
    map.rotating_pairs.push_back({.y = y, .z = z});
    map.parts = {{"shaft", spin.axes, {"", "shaft bending", "shaft bending"}, {}}};
    StabilityOptions options;
    options.modes.spin = RotorSpin::prescribed;
    const auto same = [&](double) { return CampbellCase{.system = &system, .rotor = &map}; };
    const StabilityLimits found = stability_limits(same, "", 1, 40, options);
    CAPTURE(found.note, found.diagram.method);
    REQUIRE(found.limits.size() == 1);
    const double natural = std::sqrt(k / m);
    CHECK(found.limits[0].name == "shaft bending (forward)");
    CHECK(found.limits[0].parameter == Approx(natural * (1 + outside / inside)).epsilon(1e-6));
    CHECK(found.limits[0].rotor_speed == found.limits[0].parameter);
    CHECK(found.limits[0].frequency_hz() == Approx(natural / (2 * pi)).epsilon(1e-6));
    CHECK(found.diagram.parameter.empty());
    CHECK(found.diagram.rotor_speeds().back() == 40);
}

TEST_CASE("stability limits: steps are halved where modes exchange their shapes, until it is certain which is which",
          "[property]") {
    // Two masses of 1 kg on springs p and 1 N/m, with 0.1 N/m between them.
    Remade pair{[](double p) {
        Tree tree;
        ForceSet forces;
        LinearLaw law{.name = "springs", .stiffness = (Matrix(2, 2) << p + 0.1, -0.1, -0.1, 1.1).finished()};
        for (const char* name : {"first", "second"})
            law.coordinates.push_back(
                add_joint(tree,
                          {.name = name, .kind = JointKind::prismatic, .inertia = {1, Vec3::Zero(), Mat3::Zero()}})
                    .body);
        forces.add_law(law);
        return System(tree, forces);
    }};
    pair.map.parts = {{"", Tree::base(), {"", "", "mass"}, {}}};
    StabilityOptions options;
    options.steps = 1;
    const StabilityLimits halved = stability_limits(pair.family(), "stiffness, N/m", 0.8, 1.2, options);
    CHECK(halved.limits.empty());
    CHECK(halved.diagram.points.size() > 2);
    options.halvings = 0;
    const StabilityLimits whole = stability_limits(pair.family(), "stiffness, N/m", 0.8, 1.2, options);
    CHECK(whole.diagram.points.size() == 2);
    REQUIRE(halved.diagram.branches.size() == 2);
    for (const Branch& branch : halved.diagram.branches)
        for (std::size_t i = 1; i < branch.mac.size(); ++i) CHECK(branch.mac[i] >= min_reliable_mac);
    // Through the veering, each keeps its place by frequency.
    for (std::size_t i = 0; i < halved.diagram.points.size(); ++i)
        CHECK(halved.diagram.natural_hz(halved.diagram.branches[0], i) <
              halved.diagram.natural_hz(halved.diagram.branches[1], i));
}

TEST_CASE("stability limits: what has no steady state ends the range, and says where", "[property]") {
    // Weight on lag hinges swings with every revolution.
    std::optional<SmallRotor> now;
    const auto heavy = [&](double parameter) {
        now.emplace(small_rotor({.hinges = BladeHinges::lag, .gravity = {parameter > 2.3 ? 9.81 : 0, 0, 0}}));
        return CampbellCase{.system = &now->system, .rotor = &now->map, .rotor_speed = 2};
    };
    StabilityOptions options;
    options.modes.method = CampbellMethod::coleman;
    options.modes.spin = RotorSpin::prescribed;
    options.steps = 4;
    const StabilityLimits found = stability_limits(heavy, "parameter", 1, 5, options);
    CHECK_FALSE(found.diagram.complete);
    CHECK(found.diagram.parameters.back() <= 2.3);
    CHECK(found.diagram.parameters.back() > 2.3 - 0.02);
    CHECK_THAT(found.note, Catch::Contains("no further than parameter 2.2"));
    CHECK_THROWS_AS(stability_limits(heavy, "parameter", 3, 5, options), NumericalError);
}

// A magnet that turns drags a needle along: sin(q - p) = 0. From q = 0 other turns are nearer.
TEST_CASE("stability limits: a steady state is sought from that of the neighbour", "[analytic]") {
    Remade needle{[](double p) {
        Tree tree;
        add_joint(tree, {.name = "needle", .inertia = {1, {1, 0, 0}, Mat3::Zero()}});
        ForceSet forces;
        forces.add_element(
            {.name = "magnet", .coordinates = {BodyId{0}}, .evaluate = [p](const ElementView& in, ElementForces& out) {
                 out.Q(0) -= std::sin(in.q(0) - p);
             }});
        return System(tree, forces);
    }};
    needle.map.machine = "needle";
    needle.map.parts = {{"", Tree::base(), {}, {"", "needle", ""}}};
    constexpr double last = 9;
    const StabilityLimits found = stability_limits(needle.family(), "angle, rad", 0.1, last, {.steps = 30});
    REQUIRE(found.diagram.complete);
    CHECK(found.limits.empty());
    CHECK(found.diagram.points.back().at.q(0) == Approx(last).epsilon(1e-9));
}

TEST_CASE("stability limits: progress and cancelling", "[property]") {
    Remade column = loaded_column(WrenchAxes::base);
    StabilityOptions options;
    options.steps = 4;
    std::vector<std::pair<int, int>> told;
    options.modes.progress = [&](int done, int total) { told.emplace_back(done, total); };
    options.modes.cancelled = [&] { return told.size() == 2; };
    const StabilityLimits found = stability_limits(column.family(), "load, N", 0, 4, options);
    CHECK(told == std::vector<std::pair<int, int>>{{1, 4}, {2, 4}});
    CHECK_FALSE(found.diagram.complete);
    CHECK(found.diagram.parameters.back() == 2);
    options.modes.cancelled = [] { return true; };
    const StabilityLimits none = stability_limits(column.family(), "load, N", 0, 4, options);
    CHECK_FALSE(none.diagram.complete);
    CHECK(none.limits.empty());
}

TEST_CASE("stability limits: what cannot be searched is refused", "[property]") {
    Remade column = loaded_column(WrenchAxes::base);
    const MachineFamily family = column.family();
    const auto refused = [&](double from, double to, const StabilityOptions& options,
                             std::initializer_list<std::string> parts) {
        check_refused([&] { (void)stability_limits(family, "load, N", from, to, options); }, parts);
    };
    refused(2, 2, {}, {"stability limits", "range of load, N = 2 ... 2", "finite and rising"});
    refused(not_a_number, 2, {}, {"range of load, N = nan ... 2"});
    refused(0, infinite, {}, {"range of load, N = 0 ... inf"});
    refused(0, 1, {.steps = 0}, {"number of steps = 0", ">= 1"});
    refused(0, 1, {.halvings = -1}, {"halvings of a step = -1", "0 ... 40"});
    refused(0, 1, {.tolerance = 0}, {"tolerance of the parameter = 0", "> 0"});
    refused(0, 1, {.growth = -1e-9}, {"growth that is rounding = -1e-09", ">= 0"});
    refused(0, 1, {.modes = {.method = CampbellMethod::frozen_azimuth}}, {"method = frozen azimuth"});
    const Campbell other{};
    refused(0, 1, {.modes = {.neighbour = &other}}, {"neighbour of the diagram = given"});
    check_refused([&] { (void)stability_limits({}, "load, N", 0, 1); }, {"machines = none"});
    check_refused([&] { (void)stability_limits([](double) { return CampbellCase{}; }, "load, N", 0, 1); },
                  {"system and rotor at load, N 0 = none"});
}

}  // namespace cardan::testing::stability_limit_tests
