// Contact and friction: bounces in closed form, a stick-slip oscillator.
#include "elements/machine_elements/contact.hpp"
#include "elements/machine_elements/friction.hpp"
#include "solvers/time/stick_slip.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/tree_tools.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace contact_tests {

struct Bounce {
    double restitution, depth, time, energy_error;
};

// A mass along z that arrives at v0, in one of two ways: a stop of its coordinate, or a point on a plane.
Bounce bounce(double mass, const HuntCrossley& law, double v0, bool plane) {
    Tree tree;
    const Link z =
        add_joint(tree, {.name = "z", .kind = JointKind::prismatic, .inertia = {mass, Vec3::Zero(), Mat3::Zero()}});
    ForceSet forces;
    if (plane)
        add_plane_contact(forces, {"plane", Tree::base(), z.axes, law});
    else
        forces.add_element(contact_stop("stop", z.body, 0, false, law));
    const System system(tree, forces);
    IntegrationOptions options;
    options.tolerances = {1e-11, 1e-14, 1e-14, 1e-12, 1e-12};
    double deepest = 0;
    options.events = {{.name = "deepest",
                       .function = [](const StateView& at) { return at.qd(0); },
                       .direction = 1,
                       .action =
                           [&](Integrator& run) {
                               deepest = -run.state().q(0);
                               return AfterEvent::proceed;
                           }},
                      {.name = "apart", .function = [](const StateView& at) { return at.q(0); }, .direction = 1}};
    Integrator run(system, {}, 0, Vector{{0.0}}, Vector{{-v0}}, options);
    const Advance end = run.advance(10);
    REQUIRE(end.event == "apart");
    return {run.state().qd(0) / v0, deepest, end.time, run.energy().error};
}

struct Cycle {
    double period, slip, greatest, min;
};

// m x'' + d x' + k x = friction of a belt that moves with +V: two periods from one begin of slip to the third.
Cycle creeping_cycle(double d, const StribeckFriction& law) {
    constexpr double k = 100, V = 0.2;
    Tree tree;
    const Link x =
        add_joint(tree, {.name = "x", .kind = JointKind::prismatic, .inertia = {1, Vec3::Zero(), Mat3::Zero()}});
    ForceSet forces;
    forces.add_spring("spring", x.body, k, d);
    forces.add_element(friction_force("belt", x.body, law, V));
    const System system(tree, forces);
    IntegrationOptions options;
    options.tolerances = {1e-9, 1e-11, 1e-11, 1e-10, 1e-10};
    std::vector<double> tops, bottoms, highest, lowest;
    options.events = {{.name = "top",
                       .function = [](const StateView& at) { return at.qd(0); },
                       .direction = -1,
                       .action =
                           [&](Integrator& run) {
                               tops.push_back(run.time());
                               highest.push_back(run.state().q(0));
                               return AfterEvent::proceed;
                           }},
                      {.name = "bottom",
                       .function = [](const StateView& at) { return at.qd(0); },
                       .direction = 1,
                       .action =
                           [&](Integrator& run) {
                               lowest.push_back(run.state().q(0));
                               return AfterEvent::proceed;
                           }}};
    Integrator run(system, {}, 0, Vector{{0.05}}, Vector{{V}}, options);
    REQUIRE(run.advance(4).reached());
    REQUIRE(tops.size() >= 3);
    return {tops[2] - tops[1], 0, highest[1], lowest[1]};
}

// The same by events: true sticking.
struct Slips {
    std::vector<double> begins, ends, from, to, greatest, min;
    double energy_error = 0;
};

Slips slips(double d, const StribeckFriction& law) {
    constexpr double k = 100, V = 0.2;
    Tree tree;
    const Link x =
        add_joint(tree, {.name = "x", .kind = JointKind::prismatic, .inertia = {1, Vec3::Zero(), Mat3::Zero()}});
    ForceSet forces;
    LoopSet loops;
    forces.add_spring("spring", x.body, k, d);
    const DryFriction belt = add_dry_friction(forces, loops, "belt", x.body, law, V);
    const System system(tree, forces, loops);
    const Vector q = Vector{{0.05}}, qd = Vector{{V}};
    IntegrationOptions options;
    options.tolerances = {1e-11, 1e-13, 1e-13, 1e-12, 1e-12};
    options.max_step = 0.02;
    options.events = stick_slip(system, {belt}, {}, 0, q, qd);
    REQUIRE(belt.state->engaged);
    Slips found;
    for (Event& event : options.events)
        event.action = [&found, own = event.action](Integrator& run) {
            const AfterEvent after = own(run);
            const bool sticks = run.state().qd(0) > 0.199;
            const bool begins = sticks && found.begins.size() == found.ends.size();
            (begins ? found.begins : found.ends).push_back(run.time());
            (begins ? found.from : found.to).push_back(run.state().q(0));
            return after;
        };
    const auto turning = [](std::vector<double>& places, int direction) {
        return Event{.name = "turns",
                     .function = [](const StateView& at) { return at.qd(0); },
                     .direction = direction,
                     .action =
                         [&places](Integrator& run) {
                             places.push_back(run.state().q(0));
                             return AfterEvent::proceed;
                         }};
    };
    options.events.push_back(turning(found.greatest, -1));
    options.events.push_back(turning(found.min, 1));
    Integrator run(system, {}, 0, q, qd, options);
    REQUIRE(run.advance(4.5).reached());
    found.energy_error = run.energy().error;
    return found;
}

}  // namespace contact_tests

using namespace contact_tests;

TEST_CASE("contact: restitution by Hunt and Crossley's law depends on a v0 only", "[analytic]") {
    struct Row {
        double av, e;
    };
    const std::vector<Row> rows = {{0.1, 0.937475580}, {0.25, 0.856851018}, {0.5, 0.748434932},
                                   {1, 0.593624260},   {2, 0.410719686},    {5, 0.196980245}};
    for (const Row& row : rows)
        for (const double exponent : {1.0, 1.5, 2.2}) {
            CAPTURE(row.av, exponent);
            const double v0 = 3;
            CHECK(bounce(2, {1e5, exponent, row.av / v0}, v0, exponent == 1.5).restitution ==
                  Approx(row.e).epsilon(1e-6));
        }
}

TEST_CASE("contact: depth and time of two bounces", "[discrete]") {
    for (const bool plane : {false, true}) {
        CAPTURE(plane);
        const Bounce hertz = bounce(0.5, {4e6, 1.5, 0.3}, 2, plane);
        CHECK(hertz.restitution == Approx(0.711950180).epsilon(1e-7));
        CHECK(hertz.depth == Approx(2.89611295e-3).epsilon(1e-7));
        CHECK(hertz.time == Approx(5.0757180e-3).epsilon(1e-6));
        CHECK(std::abs(hertz.energy_error) < 1e-6);
        const Bounce linear = bounce(2, {1e5, 1, 0.08}, 4, plane);
        CHECK(linear.restitution == Approx(0.823631554).epsilon(1e-7));
        CHECK(linear.depth == Approx(1.62727271e-2).epsilon(1e-7));
        CHECK(linear.time == Approx(1.4099278e-2).epsilon(1e-6));
    }
}

TEST_CASE("contact: derivatives of laws", "[property]") {
    const HuntCrossley law{3, 1.7, 0.4};
    const StribeckFriction friction{15, 9, 0.1, 2, 0.05};
    const double step = 1e-6;
    for (const double depth : {0.2, 1.3})
        for (const double speed : {-1.5, 0.0, 2.0}) {
            const HuntCrossley::Force at = law.at(depth, speed);
            CHECK(at.by_depth ==
                  Approx((law.at(depth + step, speed).force - law.at(depth - step, speed).force) / (2 * step)));
            CHECK(at.by_speed ==
                  Approx((law.at(depth, speed + step).force - law.at(depth, speed - step).force) / (2 * step)));
            CHECK(law.at(depth, 0).force ==
                  Approx((law.at(depth + step, 0).energy - law.at(depth - step, 0).energy) / (2 * step)));
        }
    CHECK(law.at(-0.1, 1).force == 0);
    CHECK(law.at(0.1, -10).force == 0);  // it never pulls
    for (const double speed : {-0.3, -0.02, 0.01, 0.2}) {
        CAPTURE(speed);
        CHECK(friction.at(speed).by_speed ==
              Approx((friction.at(speed + step).force - friction.at(speed - step).force) / (2 * step)).epsilon(1e-6));
        CHECK(friction.at(speed).force == Approx(-friction.at(-speed).force));
    }
}

TEST_CASE("friction: stick-slip on a belt", "[discrete]") {
    struct Row {
        double d, viscous, period, greatest, min;
    };
    const std::vector<Row> rows = {{0, 0, 1.0521471606, 0.160736365, 0.019617499},
                                   {1, 2, 0.8808870126, 0.159055203, 0.054206741}};
    for (const Row& row : rows) {
        CAPTURE(row.d);
        // What sticks creeps: the errors fall with the regularisation, and the limit is the one of true sticking.
        const StribeckFriction coarse{15, 9, 0.1, row.viscous, 2e-4}, fine{15, 9, 0.1, row.viscous, 1e-4};
        const Cycle twice = creeping_cycle(row.d, coarse), once = creeping_cycle(row.d, fine);
        CHECK(once.period == Approx(row.period).epsilon(3e-3));
        CHECK(std::abs(once.period - row.period) < 0.6 * std::abs(twice.period - row.period));
        CHECK(once.greatest == Approx(row.greatest).epsilon(2e-3));
        CHECK(once.min == Approx(row.min).margin(4e-4));
    }
}

TEST_CASE("friction: stick-slip by events", "[discrete]") {
    struct Row {
        double d;
        StribeckFriction law;
        double period, slip, from, to, greatest, min;
    };
    // The last: Coulomb's law with a static friction of its own, in closed form.
    const std::vector<Row> rows = {
        {0, {15, 9, 0.1}, 1.0521471606, 0.41007560, 0.15, 0.021585688, 0.160736365, 0.019617499},
        {1, {15, 9, 0.1, 2}, 0.8808870126, 0.42703810, 0.148, 0.057230218, 0.159055203, 0.054206741},
        {0, {15, 9, 0}, 0.9785093762, 0.37850938, 0.15, 0.03, 0.153245553, 0.026754447}};
    for (const Row& row : rows) {
        CAPTURE(row.period);
        const Slips found = slips(row.d, row.law);
        REQUIRE(found.begins.size() >= 3);
        CHECK(found.begins[2] - found.begins[1] == Approx(row.period).epsilon(2e-8));
        CHECK(found.ends[1] - found.begins[1] == Approx(row.slip).epsilon(5e-7));
        CHECK(found.from[1] == Approx(row.from).epsilon(1e-7));
        CHECK(found.to[1] == Approx(row.to).epsilon(1e-6));
        CHECK(found.greatest[1] == Approx(row.greatest).epsilon(1e-7));
        CHECK(found.min[1] == Approx(row.min).epsilon(1e-6));
        CHECK(std::abs(found.energy_error) < 1e-7);
    }
}

TEST_CASE("friction: three blocks in a row break loose one after another", "[analytic]") {
    // The first is pulled with a force that grows with time; springs of 100 N/m between them, each holds 1 N at most.
    Tree tree;
    ForceSet forces;
    LoopSet loops;
    std::vector<BodyId> blocks;
    std::vector<DryFriction> frictions;
    for (int i = 0; i < 3; ++i) {
        const std::string name = text("block ", i + 1);
        blocks.push_back(add_joint(tree, {.name = name,
                                          .kind = JointKind::prismatic,
                                          .axis = Vec3::UnitX(),
                                          .inertia = {1, Vec3::Zero(), Mat3::Zero()}})
                             .body);
        frictions.push_back(add_dry_friction(forces, loops, text("floor ", i + 1), blocks.back(), {1, 1, 0.1}));
    }
    forces.add_element({.name = "springs and pull",
                        .points = {{Tree::base()}},
                        .evaluate = [](const ElementView& at, ElementForces& out) {
                            const double a = 100 * (at.q(0) - at.q(1)), b = 100 * (at.q(1) - at.q(2));
                            out.Q(0) += at.time / 10 - a;
                            out.Q(1) += a - b;
                            out.Q(2) += b;
                        }});
    const System system(tree, forces, loops);
    const Vector rest = Vector::Zero(3);
    IntegrationOptions options;
    options.tolerances = {1e-8, 1e-10, 1e-10, 1e-9, 1e-9};
    options.events = stick_slip(system, frictions, {}, 0, rest, rest);
    Integrator run(system, {}, 0, rest, rest, options);
    REQUIRE(run.advance(9.99).reached());
    CHECK(run.state().q.norm() < 1e-14);
    CHECK(run.state().lambda(0) == Approx(-0.999));
    CHECK(std::abs(run.state().lambda(1)) < 1e-12);
    // Slowly pulled, the first moves by 10 mm until the second one breaks loose, from 2 N on; the third from 3 N on.
    REQUIRE(run.advance(25).reached());
    CHECK(run.state().q(0) > 0.01);
    CHECK(std::abs(run.state().q(2)) < 1e-14);
    REQUIRE(run.advance(29).reached());
    CHECK(std::abs(run.state().q(2)) < 1e-14);
    REQUIRE(run.advance(35).reached());
    CHECK(run.state().q(2) > 1e-3);
    CHECK(std::abs(run.energy().error) < 1e-6);
}

TEST_CASE("friction: a block on a slope stops, and stays or slides back", "[analytic]") {
    // Thrown uphill at 2 m/s; weight along the slope 5 N, friction 4 N or 6 N.
    for (const double hold : {4.0, 6.0}) {
        CAPTURE(hold);
        Tree tree;
        const Link block = add_joint(tree, {.name = "block",
                                            .kind = JointKind::prismatic,
                                            .axis = Vec3::UnitX(),
                                            .inertia = {1, Vec3::Zero(), Mat3::Zero()}});
        ForceSet forces;
        LoopSet loops;
        forces.set_gravity({-5, 0, 0});
        const DryFriction floor = add_dry_friction(forces, loops, "floor", block.body, {hold, hold, 0.1});
        const System system(tree, forces, loops);
        const Vector q = Vector{{0.0}}, qd = Vector{{2.0}};
        IntegrationOptions options;
        options.events = stick_slip(system, {floor}, {}, 0, q, qd);
        Integrator run(system, {}, 0, q, qd, options);
        REQUIRE(run.advance(2).reached());
        const double up = 2 / (5 + hold), reached = up, back = 2 - up;
        CHECK(run.state().q(0) == Approx(reached - std::max(0.0, 5 - hold) / 2 * back * back).epsilon(1e-9));
        CHECK(run.state().lambda(0) == Approx(hold > 5 ? 5 : 0).margin(1e-12));
        // The lock is engaged no more than by one who watches: elsewhere the law is regularised.
        check_refused([&] { (void)stick_slip(System(tree, forces), {floor}, {}, 0, q, qd); }, {"'floor'", "lock"});
    }
}

TEST_CASE("contact: what is out of range is refused", "[bad-input]") {
    ForceSet forces;
    const FrameId a{0}, b{1};
    check_refused([&] { add_plane_contact(forces, {"floor", a, b, {0, 1.5, 0}}); }, {"'floor'", "stiffness"});
    check_refused([&] { add_plane_contact(forces, {"floor", a, b, {1, 0.5, 0}}); }, {"'floor'", "exponent", "0.5"});
    check_refused([&] { (void)contact_stop("stop", BodyId{0}, not_a_number, true, {1, 1.5, 0}); }, {"'stop'", "limit"});
    check_refused([&] { (void)friction_force("belt", BodyId{0}, {1, 2, 0.1, 0, 1e-4}); }, {"'belt'", "static"});
    check_refused([&] { (void)friction_force("belt", BodyId{0}, {2, 1, -1, 0, 1e-4}); }, {"'belt'", "Stribeck"});
    check_refused([&] { (void)friction_force("belt", BodyId{0}, {2, 1, 0.1, 0, 0}); }, {"'belt'", "regularisation"});
}
