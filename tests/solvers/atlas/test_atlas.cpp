// Integration in several charts: what is handed over and what is refused. The tops are in test_time_tops.cpp.
#include "mbs/base/error.hpp"
#include "solvers/atlas/atlas.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/tree_tools.hpp"

#include <array>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

// A body on three revolute joints that carries a driven wheel and a sprung pendulum.
System carousel(const std::array<int, 3>& axes, const std::string& chart) {
    Tree tree;
    FrameId at = Tree::base();
    for (std::size_t i = 0; i < 3; ++i) {
        Joint joint{text(chart, " ", i), at, JointKind::revolute, Vec3::Unit(axes[i])};
        if (i == 2) joint.inertia = {3, Vec3(0.1, 0, 0.2), Vec3(1, 2, 2.8).asDiagonal()};
        at = add_joint(tree, joint).axes;
    }
    const FrameId body = tree.add_frame(at, {}, "body");
    add_joint(tree, {.name = "wheel",
                     .inboard = body,
                     .axis = Vec3::UnitX(),
                     .inertia = {1, Vec3::Zero(), Vec3(0.4, 0.3, 0.3).asDiagonal()},
                     .role = CoordinateRole::prescribed});
    const Link pendulum = add_joint(
        tree, {.name = "pendulum", .inboard = body, .axis = Vec3::UnitY(), .inertia = {1, {0.3, 0, 0}, Mat3::Zero()}});
    ForceSet forces;
    forces.add_spring("spring", pendulum.body, 5, 0.1);
    forces.set_gravity({0, 0, -2});
    return {tree, forces};
}

struct Carousels {
    System xyz = carousel({0, 1, 2}, "xyz"), yxz = carousel({1, 0, 2}, "yxz"), again = carousel({0, 1, 2}, "again");
    Vector q = start(0.2, -0.1, 0.3), qd = start(0.4, 1.5, 0.7);

    Vector start(double a, double b, double c) const {
        Vector v = Vector::Zero(5);
        v.head<3>() << a, b, c;
        return v;
    }
    Chart chart(const System& system, double tolerance = 1e-10) const {
        IntegrationOptions options;
        options.method = Method::erk;
        options.tolerances = {tolerance, tolerance, tolerance, tolerance, tolerance};
        return {&system, {{system.model.index("wheel"), Motion::harmonic(0, 0.6, 1.1)}}, options};
    }
};

}  // namespace

TEST_CASE("atlas: motions of drives, dissipation and the balance of energy continue from chart to chart",
          "[solvers][atlas][property]") {
    const Carousels c;
    AtlasIntegrator atlas({c.chart(c.xyz), c.chart(c.yxz)}, "body", 0, c.q, c.qd);
    REQUIRE(atlas.advance(12).reached());
    const EnergyBalance balance = atlas.integrator().energy();
    CAPTURE(atlas.changes(), balance.dissipated, balance.drives, balance.error, balance.loads);
    CHECK(atlas.changes() > 2);
    CHECK(balance.dissipated > 0.01);
    CHECK(std::abs(balance.drives) > 0.01);
    CHECK(std::abs(balance.error) < 1e-7);
    CHECK(std::abs(balance.loads) < 1e-7);
    // Wheel and pendulum as in one chart alone with short steps past its singularity.
    Integrator alone(c.xyz, c.chart(c.xyz).drives, 0, c.q, c.qd, c.chart(c.xyz, 1e-11).options);
    REQUIRE(alone.advance(12).reached());
    for (const char* name : {"wheel", "pendulum"}) {
        const int here = atlas.system().model.index(name), there = c.xyz.model.index(name);
        CHECK(std::abs(atlas.integrator().state().q(here) - alone.state().q(there)) < 1e-6);
        CHECK(std::abs(atlas.integrator().state().qd(here) - alone.state().qd(there)) < 1e-6);
    }
}

TEST_CASE("atlas: where no other chart is better it stays", "[solvers][atlas][property]") {
    const Carousels c;
    AtlasIntegrator atlas({c.chart(c.xyz, 1e-8), c.chart(c.again, 1e-8)}, "body", 0, c.q, c.qd, 0.5);
    REQUIRE(atlas.advance(6).reached());
    CHECK(atlas.changes() == 0);
    CHECK(atlas.chart() == 0);
}

TEST_CASE("atlas: the user's own events and cancellation work in every chart", "[solvers][atlas][property]") {
    const Carousels c;
    int asked = 0;
    Chart first = c.chart(c.xyz), second = c.chart(c.yxz);
    for (Chart* chart : {&first, &second}) {
        const int pendulum = chart->system->model.index("pendulum");
        chart->options.events = {{.name = "pendulum rises",
                                  .function = [pendulum](const StateView& at) { return at.q(pendulum); },
                                  .direction = 1}};
    }
    second.options.cancelled = [&] { return ++asked > 2000; };
    AtlasIntegrator atlas({first, second}, "body", 0, c.q, c.qd);
    Advance advance = atlas.advance(100);
    CHECK(advance.end == Advance::End::event);
    CHECK(advance.event == "pendulum rises");
    while (advance.end == Advance::End::event) advance = atlas.advance(100);
    CHECK(advance.end == Advance::End::cancelled);
    CHECK(atlas.chart() == 1);
    CHECK(asked == 2001);
}

TEST_CASE("atlas: bad input is refused", "[solvers][atlas][property]") {
    const Carousels c;
    const auto make = [&](std::vector<Chart> charts, const std::string& frame, double min = 0.3) {
        AtlasIntegrator(std::move(charts), frame, 0, c.q, c.qd, min);
    };
    check_refused([&] { make({c.chart(c.xyz)}, "body"); }, {"atlas of charts", "number of charts", "1", ">= 2"});
    check_refused([&] { make({c.chart(c.xyz), {}}, "body"); }, {"system of chart 1", "none"});
    check_refused([&] { make({c.chart(c.xyz), c.chart(c.yxz)}, "body", 1); }, {"minimum quality", "1"});
    check_refused([&] { make({c.chart(c.xyz), c.chart(c.yxz)}, "nobody"); }, {"nobody"});
    check_refused([&] { make({c.chart(c.xyz), c.chart(c.xyz)}, "body"); }, {"number of coordinates", "0"});
    check_refused([&] { make({c.chart(c.xyz), c.chart(c.yxz)}, "base"); }, {"'base'", "one that moves it"});
}
