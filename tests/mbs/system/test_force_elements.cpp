// Force elements with points beside such with coordinates: what they read of one another, and what is refused.
#include "tests/mbs/system/forced_tree.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

namespace cardan::testing::force_elements {

namespace {

// A force along x at the tip that depends on its place, on a state of its own, on that of a filter and on an input.
ForceElement thruster(FrameId tip, const std::string& state) {
    ForceElement element{.name = "thruster",
                         .states = {{.name = "charge", .unit = "1", .scale = 1}},
                         .points = {{tip, Vec3(0.1, 0.2, 0.3)}},
                         .reads = {state},
                         .inputs = {"demand"}};
    element.evaluate = [tip](const ElementView& at, ElementForces& out) {
        const Vec3 place = place_of(at.system.kinematics, {tip, Vec3(0.1, 0.2, 0.3)});
        out.wrenches[0].force = Vec3(std::sin(place.z()) * at.s(0) + at.others(0) * at.u(0), 0, at.qd(1));
        out.Q(0) = at.others(0) * at.others(0);
        out.f(0) = at.u(0) * at.u(0) - at.s(0) * at.others(0) + place.x();
    };
    return element;
}

ForceElement filter() {
    ForceElement element{.name = "filter",
                         .states = {{.name = "filtered rate", .unit = "rad/s", .scale = 1}},
                         .coordinates = {BodyId{2}}};
    element.evaluate = [](const ElementView& at, ElementForces& out) {
        out.f(0) = 3 * (at.qd(0) - at.s(0));
        out.Q(0) = -0.5 * at.s(0);
    };
    return element;
}

ForcedTree machine(unsigned seed) {
    return ForcedTree(seed, [](ForcedTree& at, ForceSet& set) {
        set.add_input({.name = "demand", .unit = "N", .scale = 1, .initial = 0.4});
        set.add_element(thruster(at.add_tip(), "filtered rate"));
        set.add_element(filter());
    });
}

// Q, then the rates.
Vector answer(ForcedTree& tree) {
    Vector Q(ForcedTree::n), rates(2), all(ForcedTree::n + 2);
    tree.forces().generalised_forces({tree, tree.kin()}, Q, rates);
    all << Q, rates;
    return all;
}

Vector slope(ForcedTree& tree, double& value) {
    constexpr double h = 1e-5;
    const double middle = value;
    value = middle + h;
    const Vector above = answer(tree);
    value = middle - h;
    const Vector below = answer(tree);
    value = middle;
    return (above - below) / (2 * h);
}

}  // namespace

TEST_CASE("force elements: one with points reads states of another and inputs, and is differenced by all it sees",
          "[property]") {
    for (unsigned seed = 1; seed < 6; ++seed) {
        ForcedTree tree = machine(seed);
        tree.s = Vector{{0.7, -0.2}};
        tree.u = Vector{{0.9}};
        ForceDerivatives by;
        tree.forces().derivatives({tree, tree.kin()}, by);
        const auto check = [&](double& value, const Vector& Q, const Vector& f) {
            const Vector expected = slope(tree, value);
            CHECK((Q - expected.head(ForcedTree::n)).norm() < 1e-7);
            CHECK((f - expected.tail(2)).norm() < 1e-7);
        };
        for (int i = 0; i < ForcedTree::n; ++i) {
            check(tree.q(i), -by.loads.col(i), by.states.f_q.col(i));
            check(tree.qd(i), -by.damping.col(i), by.states.f_qd.col(i));
        }
        for (int i = 0; i < 2; ++i) check(tree.s(i), by.states.Q_s.col(i), by.states.f_s.col(i));
        check(tree.u(0), by.states.Q_u.col(0), by.states.f_u.col(0));
        // It sees all coordinates, and the states belong together.
        REQUIRE(tree.forces().state_groups().size() == 1);
        CHECK(tree.forces().state_groups()[0].coordinates.size() == ForcedTree::n);
    }
}

TEST_CASE("force elements: what a channel sees of one is what the element sees", "[property]") {
    ForcedTree tree = machine(3);
    tree.s = Vector{{0.7, -0.2}};
    tree.u = Vector{{0.9}};
    const StateView at(tree, tree.kin());
    const ElementValues thruster(tree.forces().elements(), "thruster", at),
        filter(tree.forces().elements(), "filter", at);
    CHECK(thruster.view().s == Vector{{0.7}});
    CHECK(thruster.view().others == Vector{{-0.2}});
    CHECK(thruster.view().u == tree.u);
    CHECK(thruster.view().q == tree.q);
    CHECK(filter.view().s == Vector{{-0.2}});
    CHECK(filter.view().qd == tree.qd.segment(tree.model().index(BodyId{2}), 1));
    check_refused([&] { ElementValues(tree.forces().elements(), "thrustr", at); }, {"'thrustr'", "one of the system"});
}

TEST_CASE("force elements: what names nothing, or too much, is refused", "[validation]") {
    const auto refused = [](const auto& change, std::initializer_list<std::string> parts) {
        ForceElement element = thruster(Tree::base(), "filtered rate");
        change(element);
        ForceSet set;
        check_refused([&] { set.add_element(element); }, parts);
    };
    using E = ForceElement;
    refused([](E& e) { e.points = {}, e.states = {}; }, {"'thruster'", "coordinates, points and states", "none"});
    refused([](E& e) { e.coordinates = {BodyId{0}}; }, {"coordinates = 1", "0 beside points"});
    refused([](E& e) { e.points = {}, e.groups = {{}}; }, {"groups = 1", "0 without points"});
    refused([](E& e) { e.elastic = true; }, {"elastic", "false beside states"});
    refused([](E& e) { e.differences_by_inputs = true; }, {"differences_by_inputs", "false without a jacobian"});
    refused(
        [](E& e) {
            e.potential = [](const ElementView&) { return 0.0; };
            e.power = [](const ElementView&) { return ElementPower{}; };
        },
        {"potential, power", "one"});
    check_refused(
        [] {
            ForcedTree(1, [](ForcedTree& at, ForceSet& set) {
                ForceElement grouped = thruster(at.add_tip(), "filtered rate");
                grouped.reads = grouped.inputs = {};
                grouped.groups = {{{0}, {BodyId{0}}}};
                set.add_element(grouped);
                ForceElement reader = filter();
                reader.reads = {"charge"};
                set.add_element(reader);
            });
        },
        {"'filter'", "cannot read 'charge'", "'thruster'"});
}

}  // namespace cardan::testing::force_elements
