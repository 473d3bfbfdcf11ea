// Finite numbers whose products are none: refused with the quantity and the value.
#include "mbs/system/forces.hpp"
#include "tests/support/refusal.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

BodySpec hub(double mass, const Vec3& moments, const Vec3& com = Vec3::Zero(), const Vec3& place = Vec3::Zero()) {
    return {.name = "hub", .placement = Placement::translation(place), .inertia = {mass, com, moments.asDiagonal()}};
}

void check_hub_refused(const BodySpec& spec, std::initializer_list<std::string> parts) {
    check_refused([&] { Tree().add_body(spec); }, parts);
}

const Vec3 ones = Vec3::Ones();

}  // namespace

TEST_CASE("extreme values: masses, inertias and lengths", "[property]") {
    check_hub_refused(hub(1e-320, Vec3::Zero()), {"body 'hub'", "mass [kg] = 9.99", "e-321", "1e-60"});
    check_hub_refused(hub(1e300, ones), {"body 'hub'", "mass [kg] = 1e+300", "1e60"});
    check_hub_refused(hub(1, 1e-310 * ones), {"body 'hub'", "inertia tensor", "e-310"});
    check_hub_refused(hub(1, 1e200 * ones), {"body 'hub'", "inertia tensor", "1e+200"});
    check_hub_refused(hub(1, ones, Vec3(1e308, 0, 0)), {"body 'hub'", "centre of mass [m]", "1e+308", "1e30"});
    check_hub_refused(hub(1, ones, Vec3::Zero(), Vec3(0, 0, -1e308)),
                      {"body 'hub'", "origin of the placement [m]", "-1e+308", "1e30"});
    CHECK(refusal([] { Tree().add_body(hub(1e-30, 1e-30 * ones)); }) == "(accepted)");
}

TEST_CASE("extreme values: springs and loads", "[property]") {
    ForceSet forces;
    check_refused([&] { forces.add_spring("rigid", BodyId{0}, 1e200); }, {"force element 'rigid'", "1e+200", "1e100"});
    check_refused(
        [&] {
            forces.add_wrench({.name = "thrust", .wrench = {Vec3(1e200, 0, 0), Vec3::Zero()}});
        },
        {"load 'thrust'", "1e+200", "1e100"});
    CHECK(refusal([&] { forces.add_spring("rigid", BodyId{0}, 1e30); }) == "(accepted)");
}
