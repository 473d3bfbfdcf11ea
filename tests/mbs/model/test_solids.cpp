// Homogeneous solids as the points that they consist of: Gauss's rule of two points is exact for the squares that
// moments of inertia are made of, so is an even division of the circle.
#include "mbs/model/solids.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/point_masses.hpp"
#include "tests/support/refusal.hpp"

#include <array>

namespace cardan::testing::solid_tests {

namespace {

const double gauss = 1 / std::sqrt(3);

// Axes with z along a direction.
Mat3 axes_along(const Vec3& direction) {
    const Vec3 z = direction.normalized(), x = cross<double>(z, Vec3(0.3, 0.5, -0.8)).normalized();
    return (Mat3() << x, cross<double>(z, x), z).finished();
}

// Rings of points at radii with shares of the mass, at two stations along the axis.
RigidInertia rings(double mass, const Vec3& from, const Vec3& to, const std::array<double, 2>& radii) {
    const Mat3 axes = axes_along(to - from);
    std::vector<PointMass> points;
    for (const double along : {-gauss, gauss})
        for (const double radius : radii)
            for (int i = 0; i < 5; ++i) {
                const double angle = 2 * pi * i / 5;
                points.push_back(
                    {mass / 20, (from + to) / 2 + along * (to - from) / 2 +
                                    radius * (std::cos(angle) * axes.col(0) + std::sin(angle) * axes.col(1))});
            }
    return inertia_of(points);
}

void check_same(const RigidInertia& solid, const RigidInertia& points) {
    CHECK(solid.mass == Approx(points.mass).epsilon(1e-14));
    CHECK(max_abs(solid.com - points.com) < 1e-14);
    CHECK(max_abs(solid.J - points.J) < 1e-13);
    CHECK_NOTHROW(solid.check("solid"));
}

}  // namespace

TEST_CASE("solids: bar and box are the points they consist of", "[analytic]") {
    const Vec3 from(0.3, -1, 2), to(1.5, 0.4, -0.7), middle = (from + to) / 2, half = (to - from) / 2;
    check_same(slender_bar(3, from, to), inertia_of({{1.5, middle - gauss * half}, {1.5, middle + gauss * half}}));
    const Vec3 sides(0.4, 1.1, 2.3);
    std::vector<PointMass> points;
    for (const double x : {-gauss, gauss})
        for (const double y : {-gauss, gauss})
            for (const double z : {-gauss, gauss})
                points.push_back({0.25, from + Vec3(x, y, z).cwiseProduct(sides) / 2});
    check_same(solid_box(2, sides, from), inertia_of(points));
    check_same(slender_bar(1, from, from), point_mass(1, from));
}

TEST_CASE("solids: cylinder, tube and sphere are the points they consist of", "[analytic]") {
    const Vec3 from(0.3, -1, 2), to(1.5, 0.4, -0.7);
    constexpr double radius = 0.6;
    check_same(thin_tube(4, radius, from, to), rings(4, from, to, {radius, radius}));
    // Over the square of the radius, of which equal parts have equal areas.
    const auto at = [&](double share) { return radius * std::sqrt((1 + share) / 2); };
    check_same(solid_cylinder(4, radius, from, to), rings(4, from, to, {at(-gauss), at(gauss)}));
    // Sheets of a sphere: discs of radius sqrt(R^2 - z^2), by Gauss's rule of three points (z^4).
    RigidInertia sheets;
    for (const auto& [z, weight] : {std::pair(-std::sqrt(0.6), 5.0 / 9), {0.0, 8.0 / 9}, {std::sqrt(0.6), 5.0 / 9}}) {
        const double square = radius * radius * (1 - z * z), mass = 4 * weight * 3 / 4 * (1 - z * z);
        sheets = sheets + RigidInertia{mass, from + Vec3(0, 0, z * radius),
                                       mass * square / 4 * Vec3(1, 1, 2).asDiagonal().toDenseMatrix()};
    }
    check_same(solid_sphere(4, radius, from), sheets);
}

TEST_CASE("solids: what no solid can be is refused by name", "[analytic]") {
    const Vec3 x = Vec3::UnitX(), zero = Vec3::Zero();
    check_refused([&] { (void)slender_bar(-1, zero, x); }, {"slender bar", "mass", "-1"});
    check_refused([&] { (void)solid_box(1, {1, -2, 1}); }, {"solid box", "length", "-2"});
    check_refused([&] { (void)solid_cylinder(1, 1, x, x); }, {"solid cylinder", "distance of the ends", "0"});
    check_refused([&] { (void)thin_tube(1, not_a_number, zero, x); }, {"thin tube", "length", "nan"});
    check_refused([&] { (void)solid_sphere(1, 1, infinite * x); }, {"solid sphere", "place"});
}

}  // namespace cardan::testing::solid_tests
