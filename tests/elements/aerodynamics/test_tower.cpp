// A cylinder that dams the wind: complex potentials, what a flow without sources and rotation has, differences.
#include "elements/aerodynamics/tower.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

#include <complex>
#include <functional>
#include <limits>

namespace cardan::testing::tower_dam_tests {

namespace {

const Vec3 blowing(8, 0, 0);

// The whole flow at a place over the radius, in a wind along x.
Vec3 flow(TowerDam dam, const Vec3& place, double drag = 0) {
    return blowing + tower_dam(dam, blowing, place, drag);
}

// u - i v of a uniform flow, a dipole and a source.
std::complex<double> complex_velocity(std::complex<double> z, double source) {
    return 8.0 * (1.0 - 1.0 / (z * z) + source / z);
}

Vec3 ring(double radius, double angle) {
    return {radius * std::cos(angle), radius * std::sin(angle), 0};
}

}  // namespace

TEST_CASE("tower dam: the flow around a cylinder is that of the complex potential", "[analytic]") {
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        const Vec3 place = ring(uniform(random, 1, 6), uniform(random, -pi, pi));
        const double drag = uniform(random, 0, 1.5);
        const std::complex<double> z(place.x(), place.y()), plain = complex_velocity(z, 0),
                                                            bak = complex_velocity(z + 0.1, drag / (2 * pi));
        CHECK((flow(TowerDam::potential, place, drag) - Vec3(plain.real(), -plain.imag(), 0)).norm() < 1e-13);
        CHECK((flow(TowerDam::bak, place, drag) - Vec3(bak.real(), -bak.imag(), 0)).norm() < 1e-13);
        CHECK(tower_dam(TowerDam::none, blowing, place, drag) == Vec3::Zero());
    }
}

TEST_CASE("tower dam: stagnation, twice the wind at the sides, nothing through the surface", "[analytic]") {
    CHECK(flow(TowerDam::potential, {-1, 0, 0}).norm() < 1e-14);
    CHECK(flow(TowerDam::potential, {1, 0, 0}).norm() < 1e-14);
    CHECK((flow(TowerDam::potential, {0, 1, 0}) - 2 * blowing).norm() < 1e-14);
    for (int i = 0; i < 12; ++i) {
        const Vec3 normal = ring(1, 0.3 + i * pi / 6);
        CHECK(std::abs(flow(TowerDam::potential, normal).dot(normal)) < 1e-14);
    }
    // The source of Bak's correction: its strength is the drag. The trapezoidal rule on a circle is exact.
    double out = 0;
    for (int i = 0; i < 64; ++i) {
        const Vec3 normal = ring(1, 2 * pi * i / 64);
        out += tower_dam(TowerDam::bak, blowing, 3 * normal, 0.7).dot(normal) * 3 * 2 * pi / 64;
    }
    CHECK(out == Approx(0.7 * 8).epsilon(1e-12));
}

TEST_CASE("tower dam: neither sources nor rotation", "[property]") {
    const double h = 1e-5;
    for (const TowerDam dam : {TowerDam::potential, TowerDam::bak})
        for (const Vec3& place : {ring(1.2, 2.9), ring(2, 0.4), ring(1.5, -1.7)}) {
            const Vec3 x(h, 0, 0), y(0, h, 0);
            const Vec3 by_x = (flow(dam, place + x, 0.5) - flow(dam, place - x, 0.5)) / (2 * h),
                       by_y = (flow(dam, place + y, 0.5) - flow(dam, place - y, 0.5)) / (2 * h);
            // h^2 times third derivatives, and rounding over h
            CHECK(std::abs(by_x.x() + by_y.y()) < 1e-8);
            CHECK(std::abs(by_x.y() - by_y.x()) < 1e-8);
        }
}

TEST_CASE("tower dam: derivatives", "[property]") {
    Random random(8);
    const double h = 1e-6;
    for (const TowerDam dam : {TowerDam::none, TowerDam::potential, TowerDam::bak})
        for (int i = 0; i < 20; ++i) {
            const Vec3 wind = ring(uniform(random, 1, 20), uniform(random, -pi, pi)),
                       place = ring(uniform(random, 1.05, 5), uniform(random, -pi, pi));
            const double drag = uniform(random, 0, 1);
            const TowerDamSlopes slopes = tower_dam_slopes(dam, wind, place, drag);
            for (int k = 0; k < 2; ++k) {
                const Vec3 d = h * Vec3::Unit(k);
                const Vec3 by_wind =
                    (tower_dam(dam, wind + d, place, drag) - tower_dam(dam, wind - d, place, drag)) / (2 * h);
                const Vec3 by_place =
                    (tower_dam(dam, wind, place + d, drag) - tower_dam(dam, wind, place - d, drag)) / (2 * h);
                CHECK((slopes.by_wind.col(k) - by_wind).norm() < 1e-8);
                CHECK((slopes.by_place.col(k) - by_place).norm() < 1e-8 * wind.norm());
            }
            const Vec3 by_drag =
                (tower_dam(dam, wind, place, drag + h) - tower_dam(dam, wind, place, drag - h)) / (2 * h);
            CHECK((slopes.by_drag - by_drag).norm() < 1e-8);
        }
    // Calm: all of it is zero, and stays finite.
    CHECK(tower_dam(TowerDam::bak, Vec3::Zero(), {2, 0, 0}, 0.5) == Vec3::Zero());
    CHECK(tower_dam_slopes(TowerDam::bak, Vec3::Zero(), {2, 0, 0}, 0.5).by_wind.allFinite());
}

TEST_CASE("air on a tower: what is refused", "[validation]") {
    const AeroTower good{.height = {0, 50, 90}, .diameter = {6, 5, 4}, .drag = {0.5, 0.5, 0.5}};
    CHECK_NOTHROW(good.check());
    CHECK_NOTHROW(AeroTower{}.check());
    const auto with = [&](const std::function<void(AeroTower&)>& change) {
        return [&good, change] {
            AeroTower tower = good;
            change(tower);
            tower.check();
        };
    };
    check_refused(with([](AeroTower& t) { t.diameter.pop_back(); }), {"air on the tower", "diameters = 2", "3"});
    check_refused(with([](AeroTower& t) { t.height[1] = 95; }), {"row 3", "height [m] = 90", "ascending"});
    check_refused(with([](AeroTower& t) { t.diameter[1] = 0; }), {"row 2", "diameter [m] = 0", "> 0"});
    check_refused(with([](AeroTower& t) { t.drag[0] = -1; }), {"row 1", "drag coefficient = -1"});
    check_refused(with([](AeroTower& t) { t.foot = std::numeric_limits<double>::infinity(); }), {"foot", "inf"});
    check_refused(with([](AeroTower& t) { t = {.dam = TowerDam::bak}; }), {"number of rows = 0", "for a dam"});
    check_refused(with([](AeroTower& t) { t = {.height = {1}, .diameter = {1}, .drag = {1}}; }), {"rows = 1"});
    check_refused([] { AeroNacelle{.area = {1, -2, 3}}.check(); }, {"air on the nacelle", "area [m^2] = -2"});
}

}  // namespace cardan::testing::tower_dam_tests
