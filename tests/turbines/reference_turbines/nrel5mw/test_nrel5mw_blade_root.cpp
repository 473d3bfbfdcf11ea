// Motion of the root of a blade of the NREL 5 MW machine on a moving platform.
#include "examples/studies/machines/nrel5mw_assumed_modes.hpp"
#include "mbs/base/units.hpp"
#include "tests/oracles/jet.hpp"
#include "tests/oracles/platform_frames.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"

namespace cardan::testing::blade_root_tests {

using namespace turbines;
using oracles::Jet;
using Frames = oracles::PlatformFrames<Jet<1>>;

namespace {

// The axes of the oracle are X0 up, Y0, Z0 downwind.
Vec3 value(const Frames::Vector& v) {
    return {v.x.value, v.y.value, v.z.value};
}
Vec3 rate(const Frames::Vector& v) {
    return {v.x.gradient(0), v.y.gradient(0), v.z.gradient(0)};
}
Vec3 acceleration(const Frames::Vector& v) {
    return {v.x.hessian(0, 0), v.y.hessian(0, 0), v.z.hessian(0, 0)};
}
Mat3 columns(const Vec3& a, const Vec3& b, const Vec3& c) {
    return (Mat3() << a, b, c).finished();
}

}  // namespace

TEST_CASE("NREL 5 MW assumed modes: A, B and their derivatives are those of the frames written out", "[analytic]") {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        Random random(seed);
        std::array<PrescribedCoordinate, 8> c;
        std::array<Jet<1>, 8> jet;
        for (std::size_t i = 0; i < c.size(); ++i) {
            c[i].q = uniform(random, -1, 1) * (i == 7 ? pi : i < 3 ? 5 : 0.6);
            c[i].qd = uniform(random, -1, 1);
            c[i].qdd = uniform(random, -1, 1);
            jet[i] = Jet<1>(c[i].q);
            jet[i].gradient(0) = c[i].qd;
            jet[i].hessian(0, 0) = c[i].qdd;
        }
        const Frames f({jet[0], jet[1], jet[2], jet[3], jet[4], jet[5], jet[6], jet[7]});
        const Mat3 E = columns(value(f.e1), value(f.e2), value(f.e3));
        const Mat3 E1 = columns(rate(f.e1), rate(f.e2), rate(f.e3));
        const Mat3 E2 = columns(acceleration(f.e1), acceleration(f.e2), acceleration(f.e3));
        const auto axial = [](const Mat3& W) { return Vec3(W(2, 1), W(0, 2), W(1, 0)); };
        const HubMotion m = nrel5mw_blade_root({c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]});
        CHECK((m.A - axial(E.transpose() * E1)).norm() < 1e-13);
        CHECK((m.A_dot - axial(E.transpose() * E2 + E1.transpose() * E1)).norm() < 1e-13);
        CHECK((m.B - E.transpose() * rate(f.root)).norm() < 1e-11);
        CHECK((m.B_dot - E.transpose() * acceleration(f.root) - E1.transpose() * rate(f.root)).norm() < 1e-11);
        CHECK((m.gravity + units::standard_gravity * E.row(0).transpose()).norm() < 1e-13);
    }
}

}  // namespace cardan::testing::blade_root_tests
