// Rigid inertia: joining bodies, Binet's tensor.
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/point_masses.hpp"

using namespace cardan;
using namespace cardan::testing;

TEST_CASE("inertia: parts joined in one body equal all their points together", "[analytic]") {
    Random random(1);
    for (int i = 0; i < 50; ++i) {
        const std::vector<PointMass> first = random_points(random), second = random_points(random);
        const Placement at = random_placement(random);
        std::vector<PointMass> all = first;
        for (const PointMass& p : second) all.push_back({p.m, at * p.x});
        const RigidInertia joined = inertia_of(first) + inertia_of(second).in(at), expected = inertia_of(all);
        REQUIRE(joined.mass == Approx(expected.mass).epsilon(1e-14));
        REQUIRE(max_abs(joined.com - expected.com) < 1e-14);
        REQUIRE(max_abs(joined.J - expected.J) < 1e-13);
    }
}

TEST_CASE("inertia: Binet's tensor is the sum of m x x^T about the centre, the ordinary tensor comes back from it",
          "[analytic]") {
    Random random(2);
    const std::vector<PointMass> points = random_points(random);
    const RigidInertia body = inertia_of(points);
    Mat3 P = Mat3::Zero();
    for (const PointMass& p : points) P += p.m * (p.x - body.com) * (p.x - body.com).transpose();
    CHECK(max_abs(binet_tensor<double>(body.J) - P) < 1e-14);
    CHECK(max_abs(ordinary_tensor<double>(P) - body.J) < 1e-14);
}

TEST_CASE("inertia: adding a massless body keeps the centre and adds the tensor", "[analytic]") {
    Random random(3);
    const RigidInertia body = random_inertia(random);
    RigidInertia spin;
    spin.com = Vec3(5, 6, 7);
    spin.J.diagonal() << 0.3, 0.2, 0.4;
    for (const RigidInertia& sum : {body + spin, spin + body}) {
        CHECK(sum.mass == body.mass);
        CHECK(max_abs(sum.com - body.com) < 1e-15);
        CHECK(max_abs(sum.J - body.J - spin.J) < 1e-15);
    }
    CHECK((RigidInertia{} + RigidInertia{}).is_massless());
    CHECK_FALSE(spin.is_massless());
}
