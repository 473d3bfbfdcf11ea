// Elements with states: their place in the system's derivatives, what they may name, and that they cost no allocation.
#include "tests/mbs/system/forced_tree.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <cmath>

namespace cardan::testing::state_forces {

namespace {

// Two states of which one drives the other, forces on two coordinates, a state of another element and an input.
ForceElement drive(bool with_jacobian) {
    ForceElement element{.name = "drive",
                         .states = {{.name = "flux", .unit = "V s", .scale = 0.5, .initial = 0.2},
                                    {.name = "current", .unit = "A", .scale = 40}},
                         .coordinates = {BodyId{2}, BodyId{5}},
                         .reads = {"filter"},
                         .inputs = {"demand"}};
    element.evaluate = [](const ElementView& in, ElementForces& out) {
        out.Q(0) += in.s(0) * in.s(1) - 0.3 * in.qd(0) * in.qd(1);
        out.Q(1) += std::sin(in.q(0)) * in.u(0) + in.others(0) * in.q(1);
        out.f(0) += -2 * in.s(0) + std::cos(in.q(1)) + 0.1 * in.time;
        out.f(1) += in.qd(0) * in.s(0) - in.s(1) * in.s(1) / 40 + in.u(0) * in.others(0);
    };
    if (with_jacobian)
        element.jacobian = [](const ElementView& in, ElementJacobian& d) {
            d.Q_s(0, 0) += in.s(1);
            d.Q_s(0, 1) += in.s(0);
            d.Q_qd(0, 0) -= 0.3 * in.qd(1);
            d.Q_qd(0, 1) -= 0.3 * in.qd(0);
            d.Q_q(1, 0) += std::cos(in.q(0)) * in.u(0);
            d.Q_u(1, 0) += std::sin(in.q(0));
            d.Q_others(1, 0) += in.q(1);
            d.Q_q(1, 1) += in.others(0);
            d.f_s(0, 0) -= 2;
            d.f_q(0, 1) -= std::sin(in.q(1));
            d.f_qd(1, 0) += in.s(0);
            d.f_s(1, 0) += in.qd(0);
            d.f_s(1, 1) -= in.s(1) / 20;
            d.f_u(1, 0) += in.others(0);
            d.f_others(1, 0) += in.u(0);
        };
    return element;
}

ForceElement filter() {
    ForceElement element{
        .name = "filter", .states = {{.name = "filter", .unit = "rad/s", .scale = 2}}, .coordinates = {BodyId{7}}};
    element.evaluate = [](const ElementView& in, ElementForces& out) { out.f(0) += (in.qd(0) - in.s(0)) / 0.4; };
    element.jacobian = [](const ElementView&, ElementJacobian& d) {
        d.f_qd(0, 0) += 1 / 0.4;
        d.f_s(0, 0) -= 1 / 0.4;
    };
    return element;
}

// With a spring beside them, which must not be touched.
ForcedTree machine(unsigned seed, bool with_jacobian) {
    return ForcedTree(seed, [&](ForcedTree&, ForceSet& set) {
        set.add_input({.name = "demand", .unit = "N m", .scale = 100, .initial = 7});
        set.add_element(drive(with_jacobian));
        set.add_spring("spring", BodyId{3}, 30, 0.2);
        set.add_element(filter());
    });
}

struct States {
    Vector s, u;
    // The tree gets them.
    StateView of(ForcedTree& tree) const {
        tree.s = s;
        tree.u = u;
        return {tree, tree.kin()};
    }
};

States some_states() {
    States states{Vector(3), Vector(1)};
    states.s << 0.3, 25, -1.1;
    states.u << 12;
    return states;
}

ForceDerivatives derivatives(ForcedTree& tree, const States& states) {
    ForceDerivatives out;
    tree.forces().derivatives(states.of(tree), out);
    return out;
}

struct Values {
    Vector Q, f;
};

Values values(ForcedTree& tree, const States& states) {
    Values out{Vector(ForcedTree::n), Vector(3)};
    tree.forces().generalised_forces(states.of(tree), out.Q, out.f);
    return out;
}

}  // namespace

TEST_CASE("elements with states: tables hold what they declared, in order", "[property]") {
    const ForcedTree tree = machine(1, true);
    REQUIRE(tree.forces().states().size() == 3);
    CHECK(tree.forces().states()[0].name == "flux");
    CHECK(tree.forces().states().index("filter") == 2);
    CHECK(tree.forces().states().initial() == Vector(Vec3(0.2, 0, 0)));
    CHECK(tree.forces().inputs().initial()(0) == 7);
    CHECK_THAT(refusal([&] { (void)tree.forces().states().index("fluxx"); }),
               Catch::Contains("unknown state 'fluxx'") && Catch::Contains("'flux', 'current', 'filter'"));
}

TEST_CASE("elements with states: forces and rates stand in the rows of what they named", "[analytic]") {
    ForcedTree tree = machine(2, true);
    const States states = some_states();
    const Values all = values(tree, states);
    const int a = tree.model().index(BodyId{2}), b = tree.model().index(BodyId{5}), c = tree.model().index(BodyId{7}),
              spring = tree.model().index(BodyId{3});
    const double Qa = 0.3 * 25 - 0.3 * tree.qd(a) * tree.qd(b), Qb = std::sin(tree.q(a)) * 12 - 1.1 * tree.q(b);
    CHECK(all.Q(a) == Approx(Qa).epsilon(1e-14));
    CHECK(all.Q(b) == Approx(Qb).epsilon(1e-14));
    CHECK(all.Q(spring) == Approx(-30 * tree.q(spring) - 0.2 * tree.qd(spring)).epsilon(1e-14));
    CHECK(all.f(0) == Approx(-0.6 + std::cos(tree.q(b)) + 0.07).epsilon(1e-14));
    CHECK(all.f(1) == Approx(tree.qd(a) * 0.3 - 625.0 / 40 - 12 * 1.1).epsilon(1e-14));
    CHECK(all.f(2) == Approx((tree.qd(c) + 1.1) / 0.4).epsilon(1e-14));
}

TEST_CASE("elements with states: derivatives of the system are central differences of its forces and rates",
          "[property]") {
    for (unsigned seed = 0; seed < 5; ++seed) {
        ForcedTree tree = machine(seed, true);
        States states = some_states();
        const ForceDerivatives d = derivatives(tree, states);
        const double h = 1e-5;
        const auto column = [&](double& value) {
            const double middle = value;
            value = middle + h;
            const Values above = values(tree, states);
            value = middle - h;
            const Values below = values(tree, states);
            value = middle;
            return Values{(above.Q - below.Q) / (2 * h), (above.f - below.f) / (2 * h)};
        };
        for (int i = 0; i < ForcedTree::n; ++i) {
            const Values by_q = column(tree.q(i)), by_qd = column(tree.qd(i));
            CHECK((by_q.Q + d.elastic.col(i) + d.loads.col(i)).norm() < 1e-8);
            CHECK((by_qd.Q + d.damping.col(i)).norm() < 1e-8);
            CHECK((by_q.f - d.states.f_q.col(i)).norm() < 1e-8);
            CHECK((by_qd.f - d.states.f_qd.col(i)).norm() < 1e-8);
        }
        for (int i = 0; i < 3; ++i) {
            const Values by_s = column(states.s(i));
            CHECK((by_s.Q - d.states.Q_s.col(i)).norm() < 1e-7);
            CHECK((by_s.f - d.states.f_s.col(i)).norm() < 1e-7);
        }
        const Values by_u = column(states.u(0));
        CHECK((by_u.Q - d.states.Q_u.col(0)).norm() < 1e-7);
        CHECK((by_u.f - d.states.f_u.col(0)).norm() < 1e-7);
    }
}

TEST_CASE("elements with states: without a Jacobian they are differenced", "[property]") {
    ForcedTree given = machine(3, true), differenced = machine(3, false);
    const ForceDerivatives a = derivatives(given, some_states()), b = derivatives(differenced, some_states());
    CHECK((a.loads - b.loads).norm() < 1e-8);
    CHECK((a.damping - b.damping).norm() < 1e-8);
    CHECK((a.states.Q_s - b.states.Q_s).norm() < 1e-7);
    CHECK((a.states.f_s - b.states.f_s).norm() < 1e-7);
    CHECK((a.states.f_q - b.states.f_q).norm() < 1e-8);
    CHECK((a.states.Q_u - b.states.Q_u).norm() < 1e-7);
}

TEST_CASE("elements with states: evaluation and derivatives allocate nothing", "[property]") {
    for (const bool with_jacobian : {true, false}) {
        ForcedTree tree = machine(4, with_jacobian);
        const States states = some_states();
        const StateView at = states.of(tree);
        Values out = values(tree, states);
        ForceDerivatives d = derivatives(tree, states);
        CHECK(allocations([&] {
                  tree.forces().generalised_forces(at, out.Q, out.f);
                  tree.forces().derivatives(at, d);
              }) == 0);
    }
}

TEST_CASE("elements with states: a load factor multiplies their forces, not the rates of their states", "[property]") {
    ForcedTree tree = machine(5, true);
    const States states = some_states();
    const Forces twice = tree.forces().with_load_factor(2, false);
    Values once = values(tree, states), both = once;
    twice.generalised_forces(states.of(tree), both.Q, both.f);
    const int a = tree.model().index(BodyId{2}), spring = tree.model().index(BodyId{3});
    CHECK(both.Q(a) == Approx(2 * once.Q(a)).epsilon(1e-14));
    CHECK(both.Q(spring) == once.Q(spring));
    CHECK(both.f == once.f);
}

TEST_CASE("elements with states: what does not take them into account refuses them", "[property]") {
    ForcedTree tree = machine(6, true);
    check_refused([&] { (void)tree.Q(); }, {"number of states = 3"});
    ForceDerivatives d;
    check_refused([&] { tree.forces().derivatives({tree, tree.kin()}, d); }, {"force elements", "states", "3"});
    Values out{Vector(ForcedTree::n), Vector(3)};
    check_refused(
        [&] {
            tree.forces().generalised_forces({tree, tree.kin()}, out.Q, out.f);
        },
        {"force elements", "states", "3"});
}

TEST_CASE("elements with states: names, scales and coordinates that cannot be are refused", "[property]") {
    const auto with = [](auto change, std::initializer_list<std::string> parts) {
        ForceElement element = drive(true);
        InputInfo input{.name = "demand", .unit = "N m", .scale = 100};
        change(element, input);
        check_refused(
            [&] {
                ForcedTree(1, [&](ForcedTree&, ForceSet& set) {
                    set.add_input(input);
                    set.add_element(element);
                    set.add_element(filter());
                });
            },
            parts);
    };
    using E = ForceElement;
    with([](E& e, InputInfo&) { e.states[1].scale = 0; }, {"'drive'", "state 'current'", "scale [A] = 0", "> 0"});
    with([](E& e, InputInfo&) { e.states[1].unit = ""; }, {"'drive'", "state 'current'", "unit is missing"});
    with([](E& e, InputInfo&) { e.states[1].name = "flux"; }, {"'drive'", "state 'flux'", "there already"});
    with([](E& e, InputInfo&) { e.states[0].name = "demand"; }, {"state 'demand'", "there already"});
    with([](E& e, InputInfo&) { e.states[0].initial = NAN; }, {"state 'flux'", "value at the start [V s]", "finite"});
    with([](E& e, InputInfo&) { e.coordinates[1] = BodyId{99}; }, {"'drive'", "body = 99"});
    with([](E& e, InputInfo&) { e.reads[0] = "filtre"; }, {"'drive'", "unknown state 'filtre'", "'filter'"});
    with([](E& e, InputInfo&) { e.inputs[0] = "demnd"; }, {"'drive'", "unknown input 'demnd'", "'demand'"});
    with([](E& e, InputInfo&) { e.evaluate = {}; }, {"'drive'", "`evaluate` is missing"});
    with([](E&, InputInfo& i) { i.scale = -1; }, {"input 'demand'", "scale [N m] = -1"});
    const std::string coordinate = ForcedTree(1, [](ForcedTree&, ForceSet&) {}).model().coordinates()[0].name;
    with([&](E& e, InputInfo&) { e.states[0].name = coordinate; }, {text("state '", coordinate, "'"), "coordinate"});
}

}  // namespace cardan::testing::state_forces
