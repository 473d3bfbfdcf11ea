// The memory of the kernels as an object that is copied and moved.
#include "mbs/kernels/dynamics.hpp"
#include "tests/mbs/sampled_tree.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <utility>

using namespace cardan;
using namespace cardan::testing;

TEST_CASE("workspace: a copy has arrays of its own, one that was moved from is refused", "[property]") {
    SampledTree s(5, {.bodies = 12, .added_mass = 0.4});
    const Matrix g = s.g();
    const auto metric_of = [&](Workspace& workspace) {
        Matrix m(s.n, s.n);
        metric(kinematics(s.model, s.q, workspace), m);
        return m;
    };
    Workspace copy = s.workspace, moved = Workspace(copy), assigned(s.model);
    CHECK(copy.generation() == s.workspace.generation());
    CHECK(metric_of(copy) == g);
    CHECK(metric_of(moved) == g);
    assigned = copy;
    kinematics(s.model, s.qd, copy);  // elsewhere
    CHECK(metric_of(assigned) == g);
    CHECK(s.g() == g);

    const Workspace taken = std::move(copy);
    CHECK(taken.model_serial() == s.model.serial());
    CHECK_THAT(refusal([&] { kinematics(s.model, s.q, copy); }),  // NOLINT(bugprone-use-after-move)
               Catch::Matchers::Contains("belongs to another model"));
    copy = taken;
    CHECK(metric_of(copy) == g);
}

TEST_CASE("kinematics: the last body and the one after it", "[property]") {
    const SampledTree s(6, {.bodies = 9});
    const int last = s.n - 1;
    CHECK(s.kin.rotation(last).col(2) == s.kin.axis(last));
    CHECK((s.kin.rotation(last).transpose() * s.kin.rotation(last) - Mat3::Identity()).norm() < 1e-14);
    const Vec3 in_body = s.kin.rotation(last).transpose() * (s.kin.centre_of_mass(last) - s.kin.origin(last));
    CHECK((in_body - s.model.body(last).inertia.com).norm() < 1e-13);
    CHECK(refusal([&] { static_cast<void>(s.kin.origin(s.n)); }) != "(accepted)");
    CHECK(refusal([&] { static_cast<void>(s.kin.axis(-1)); }) != "(accepted)");
}

TEST_CASE("forward dynamics: a copy has memory of its own", "[property]") {
    SampledTree s(7, {.bodies = 12, .armatures = true, .added_mass = 0.4});
    ForwardDynamics first(s.model);
    Vector expected = Vector::Zero(s.n), qdd = expected, actuator = expected;
    first.solve(s.kin, s.qd, s.q, expected, actuator);
    ForwardDynamics copy = first, moved = std::move(first);
    first = copy;
    for (ForwardDynamics* dynamics : {&copy, &moved, &first}) {
        qdd.setZero();
        dynamics->solve(s.kin, s.qd, s.q, qdd, actuator);
        CHECK(qdd == expected);
    }
}
