// Fields of wrenches: the same as loads on frames where they are constant, and what they add to the loads of joints.
#include "mbs/base/error.hpp"
#include "mbs/kernels/kinematics.hpp"
#include "mbs/system/joint_loads.hpp"
#include "tests/mbs/system/forced_tree.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

namespace cardan::testing::field_tests {

namespace {

struct DeadLoads {
    std::vector<FramePoint> points;
    std::vector<Wrench> wrenches;
};

DeadLoads random_loads(ForcedTree& at) {
    DeadLoads out;
    for (int body = 0; body < ForcedTree::n; body += 2)
        for (int i = 0; i < 2; ++i) {
            out.points.push_back({at.frame(body), random_vector(at.random, 2)});
            out.wrenches.push_back({random_vector(at.random, 5), random_vector(at.random, 5)});
        }
    out.points.push_back({Tree::base(), Vec3::Zero()});  // the ground takes whatever it gets
    out.wrenches.push_back({Vec3(1, 2, 3), Vec3(4, 5, 6)});
    return out;
}

ForceElement field_of(const DeadLoads& loads) {
    return {.name = "field",
            .points = loads.points,
            .evaluate = [own = loads.wrenches](const ElementView&, ElementForces& out) {
                std::copy(own.begin(), own.end(), out.wrenches.begin());
            }};
}

// Two systems on one tree: the loads as a field, and one by one.
struct Twins {
    explicit Twins(unsigned seed)
        : as_field(seed, [](ForcedTree& at, ForceSet& set) { set.add_element(field_of(random_loads(at))); }),
          one_by_one(seed, [](ForcedTree& at, ForceSet& set) {
              const DeadLoads loads = random_loads(at);
              for (std::size_t i = 0; i < loads.points.size(); ++i)
                  set.add_wrench({text("load ", i),
                                  at.tree.add_frame(loads.points[i].frame,
                                                    Placement::translation(loads.points[i].place), text("point ", i)),
                                  loads.wrenches[i]});
          }) {
        as_field.q = one_by_one.q;  // the random numbers of both went the same way until here
        as_field.qd = one_by_one.qd;
    }
    ForcedTree as_field, one_by_one;
};

}  // namespace

TEST_CASE("fields: constant wrenches have the forces and derivatives of loads on frames", "[crosscheck]") {
    for (unsigned seed = 0; seed < 10; ++seed) {
        Twins twins(seed);
        const Vector Q = twins.one_by_one.Q();
        CHECK(scaled(twins.as_field.Q() - Q, Q) < 1e-13);
        const auto derivatives = [](ForcedTree& at, const Forces& forces) {
            ForceDerivatives out;
            forces.derivatives({at, at.kin()}, out);
            return out;
        };
        const ForceDerivatives own = derivatives(twins.as_field, twins.as_field.forces()),
                               expected = derivatives(twins.one_by_one, twins.one_by_one.forces());
        CHECK((own.loads - expected.loads).norm() < 1e-7 * expected.loads.norm());  // differences
        CHECK(own.damping.isZero(1e-7));
        const Forces doubled = twins.as_field.forces().with_load_factor(2, false);
        CHECK(scaled(twins.as_field.Q(doubled) - 2 * Q, Q) < 1e-13);
        CHECK((derivatives(twins.as_field, doubled).loads - 2 * expected.loads).norm() < 2e-7 * expected.loads.norm());
        const std::vector<ForceReport> report = twins.as_field.report();
        REQUIRE(report.size() == 1);
        CHECK(report[0].name == "field");
        CHECK(report[0].power == Approx(Q.dot(twins.as_field.qd)));
        CHECK(!report[0].energy);
    }
}

TEST_CASE("fields: joints carry them", "[crosscheck]") {
    Twins twins(3);
    const Vector qdd = random_state(twins.as_field.random, ForcedTree::n);
    const auto loads = [&](ForcedTree& at) { return joint_loads({at, at.kin()}, at.forces(), qdd); };
    const JointLoads own = loads(twins.as_field), expected = loads(twins.one_by_one);
    for (std::size_t k = 0; k < own.joint.size(); ++k) {
        CHECK((own.joint[k].force - expected.joint[k].force).norm() < 1e-12);
        CHECK((own.joint[k].moment - expected.joint[k].moment).norm() < 1e-11);
    }
    REQUIRE(own.elements.size() == 1);
    CHECK(own.elements[0].size() == twins.as_field.forces().elements()[0].points.size());
}

namespace {

// A Maxwell element between the ground and the origin of a body: the spring's force s along x, ds/dt = k v - k/c s.
ForceElement maxwell_field(const ForcedTree& at, int body, bool exact) {
    constexpr double k = 30, c = 7;
    ForceElement field{.name = "bushing", .points = {{at.frame(body), Vec3::Zero()}}};
    field.states = {{.name = "bushing force", .unit = "N", .scale = 2}};
    // Of the origin, along x.
    const auto twist = [body](const StateView& in, int a) {
        const Model& model = in.kinematics.model();
        return model.precedes(a, model.index(BodyId{body}))
                   ? twist_at(in.kinematics, a, in.kinematics.origin(model.index(BodyId{body}))).v.x()
                   : 0.0;
    };
    field.evaluate = [twist](const ElementView& in, ElementForces& out) {
        double v = 0;
        for (int a = 0; a < in.q.size(); ++a) v += twist(in.system, a) * in.qd(a);
        out.wrenches[0] = {Vec3(-in.s(0), 0, 0), Vec3::Zero()};
        out.f(0) = k * v - k / c * in.s(0);
    };
    if (exact)
        field.jacobian = [twist](const ElementView& in, ElementJacobian& J) {
            // By the states and the rates; what turns with q is left to the differences of the other one.
            for (int a = 0; a < in.q.size(); ++a) {
                J.Q_s(a, 0) += -twist(in.system, a);
                J.f_qd(0, a) += k * twist(in.system, a);
            }
            J.f_s(0, 0) += -k / c;
        };
    return field;
}

}  // namespace

TEST_CASE("fields: with a state, by differences and exactly", "[crosscheck]") {
    for (unsigned seed = 1; seed < 6; ++seed) {
        const auto make = [&](bool exact) {
            return ForcedTree(seed,
                              [exact](ForcedTree& at, ForceSet& set) { set.add_element(maxwell_field(at, 5, exact)); });
        };
        ForcedTree tree = make(false), exact = make(true);
        const Vector s = tree.s = exact.s = Vector::Constant(1, 1.7);
        CHECK(tree.forces().states().size() == 1);
        REQUIRE(tree.forces().state_groups().size() == 1);
        CHECK(tree.forces().state_groups()[0].coordinates.size() == ForcedTree::n);
        Vector Q(ForcedTree::n), rates(1);
        tree.forces().generalised_forces({tree, tree.kin()}, Q, rates);
        ForceDerivatives a, b, c;
        tree.forces().derivatives({tree, tree.kin()}, a);
        const StateView at(exact, exact.kin());
        exact.forces().derivatives(at, b);
        const StateDerivatives &by_differences = a.states, &by_hand = b.states, &half_states = c.states;
        CHECK((by_differences.Q_s - by_hand.Q_s).norm() < 1e-8 * (1 + by_hand.Q_s.norm()));
        CHECK((by_differences.f_qd - by_hand.f_qd).norm() < 1e-7 * (1 + by_hand.f_qd.norm()));
        CHECK((by_differences.f_s - by_hand.f_s).norm() < 1e-8);
        // The force is linear in the state; half of it, with half the derivatives, on a system with that factor.
        CHECK((Q - by_hand.Q_s * s).norm() < 1e-12 * (1 + Q.norm()));
        const Forces half = exact.forces().with_load_factor(0.5, false);
        Vector half_Q(ForcedTree::n), same_rates(1);
        half.generalised_forces(at, half_Q, same_rates);
        CHECK((half_Q - Q / 2).norm() < 1e-12 * (1 + Q.norm()));
        CHECK(same_rates(0) == Approx(rates(0)));
        half.derivatives(at, c);
        CHECK((half_states.Q_s - by_hand.Q_s / 2).norm() < 1e-12 * (1 + by_hand.Q_s.norm()));
        CHECK((half_states.f_qd - by_hand.f_qd).isZero(0));
        check_refused([&] { tree.Q(); }, {"forces", "number of states", "1"});
    }
}

TEST_CASE("fields: what is refused", "[validation]") {
    ForceSet set;
    check_refused([&] { set.add_element({.name = "air"}); }, {"air", "evaluate"});
    check_refused(
        [&] {
            set.add_element({.name = "air",
                             .points = {{Tree::base(), Vec3(0, std::nan(""), 0)}},
                             .evaluate = [](const ElementView&, ElementForces&) {}});
        },
        {"air", "place [m]", "finite"});
    check_refused(
        [&] {
            ForcedTree(1, [](ForcedTree&, ForceSet& forces) {
                forces.add_element({.name = "air",
                                    .points = {{FrameId{999}, Vec3::Zero()}},
                                    .evaluate = [](const ElementView&, ElementForces&) {}});
            });
        },
        {"air", "frame", "999"});
}

}  // namespace cardan::testing::field_tests
