// Flow around a cylinder and its wake: complex potentials, what a flow without sources and rotation has, differences.
#include "elements/aerodynamics/tower.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

#include <array>
#include <complex>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace cardan::testing::tower_influence_tests {

namespace {

const Vec3 blowing(8, 0, 0);

// The whole flow at a place over the radius, in a wind along x.
Vec3 flow(TowerInfluence influence, const Vec3& place, double drag = 0) {
    return blowing + tower_influence(influence, blowing, place, drag);
}

constexpr std::array shadows{TowerShadow::powles, TowerShadow::eames};

// u - i v of a uniform flow, a dipole and a source.
std::complex<double> complex_velocity(std::complex<double> z, double source) {
    return 8.0 * (1.0 - 1.0 / (z * z) + source / z);
}

Vec3 ring(double radius, double angle) {
    return {radius * std::cos(angle), radius * std::sin(angle), 0};
}

}  // namespace

TEST_CASE("tower influence: the flow around a cylinder is that of the complex potential", "[analytic]") {
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        const Vec3 place = ring(uniform(random, 1, 6), uniform(random, -pi, pi));
        const double drag = uniform(random, 0, 1.5);
        const std::complex<double> z(place.x(), place.y()), plain = complex_velocity(z, 0),
                                                            bak = complex_velocity(z + 0.1, drag / (2 * pi));
        CHECK((flow(TowerInfluence::potential, place, drag) - Vec3(plain.real(), -plain.imag(), 0)).norm() < 1e-13);
        CHECK((flow(TowerInfluence::bak, place, drag) - Vec3(bak.real(), -bak.imag(), 0)).norm() < 1e-13);
        CHECK(tower_influence(TowerInfluence::none, blowing, place, drag) == Vec3::Zero());
    }
}

TEST_CASE("tower influence: stagnation, twice the wind at the sides, nothing through the surface", "[analytic]") {
    CHECK(flow(TowerInfluence::potential, {-1, 0, 0}).norm() < 1e-14);
    CHECK(flow(TowerInfluence::potential, {1, 0, 0}).norm() < 1e-14);
    CHECK((flow(TowerInfluence::potential, {0, 1, 0}) - 2 * blowing).norm() < 1e-14);
    for (int i = 0; i < 12; ++i) {
        const Vec3 normal = ring(1, 0.3 + i * pi / 6);
        CHECK(std::abs(flow(TowerInfluence::potential, normal).dot(normal)) < 1e-14);
    }
    // The source of Bak's correction: its strength is the drag. The trapezoidal rule on a circle is exact.
    double out = 0;
    for (int i = 0; i < 64; ++i) {
        const Vec3 normal = ring(1, 2 * pi * i / 64);
        out += tower_influence(TowerInfluence::bak, blowing, 3 * normal, 0.7).dot(normal) * 3 * 2 * pi / 64;
    }
    CHECK(out == Approx(0.7 * 8).epsilon(1e-12));
}

TEST_CASE("tower influence: neither sources nor rotation", "[property]") {
    const double h = 1e-5;
    for (const TowerInfluence influence : {TowerInfluence::potential, TowerInfluence::bak})
        for (const Vec3& place : {ring(1.2, 2.9), ring(2, 0.4), ring(1.5, -1.7)}) {
            const Vec3 x(h, 0, 0), y(0, h, 0);
            const Vec3 by_x = (flow(influence, place + x, 0.5) - flow(influence, place - x, 0.5)) / (2 * h),
                       by_y = (flow(influence, place + y, 0.5) - flow(influence, place - y, 0.5)) / (2 * h);
            // h^2 times third derivatives, and rounding over h
            CHECK(std::abs(by_x.x() + by_y.y()) < 1e-8);
            CHECK(std::abs(by_x.y() - by_y.x()) < 1e-8);
        }
}

TEST_CASE("tower influence: derivatives", "[property]") {
    Random random(8);
    const double h = 1e-6;
    for (const TowerInfluence influence : {TowerInfluence::none, TowerInfluence::potential, TowerInfluence::bak})
        for (int i = 0; i < 20; ++i) {
            const Vec3 wind = ring(uniform(random, 1, 20), uniform(random, -pi, pi)),
                       place = ring(uniform(random, 1.05, 5), uniform(random, -pi, pi));
            const double drag = uniform(random, 0, 1);
            const TowerInfluenceSlopes slopes = tower_influence_slopes(influence, wind, place, drag);
            for (int k = 0; k < 2; ++k) {
                const Vec3 d = h * Vec3::Unit(k);
                const Vec3 by_wind = (tower_influence(influence, wind + d, place, drag) -
                                      tower_influence(influence, wind - d, place, drag)) /
                                     (2 * h);
                const Vec3 by_place = (tower_influence(influence, wind, place + d, drag) -
                                       tower_influence(influence, wind, place - d, drag)) /
                                      (2 * h);
                CHECK((slopes.by_wind.col(k) - by_wind).norm() < 1e-8);
                CHECK((slopes.by_place.col(k) - by_place).norm() < 1e-8 * wind.norm());
            }
            const Vec3 by_drag = (tower_influence(influence, wind, place, drag + h) -
                                  tower_influence(influence, wind, place, drag - h)) /
                                 (2 * h);
            CHECK((slopes.by_drag - by_drag).norm() < 1e-8);
        }
    // Calm: all of it is zero, and stays finite.
    CHECK(tower_influence(TowerInfluence::bak, Vec3::Zero(), {2, 0, 0}, 0.5) == Vec3::Zero());
    CHECK(tower_influence_slopes(TowerInfluence::bak, Vec3::Zero(), {2, 0, 0}, 0.5).by_wind.allFinite());
}

TEST_CASE("tower shadow: along the wind, the same left and right, none before the tower and beside it", "[property]") {
    Random random(5);
    for (const TowerShadow shadow : shadows)
        for (int i = 0; i < 200; ++i) {
            const double angle = uniform(random, -pi, pi), place_angle = uniform(random, -pi, pi),
                         r = uniform(random, 1, 9), drag = uniform(random, 0.1, 1.2),
                         turbulence = uniform(random, 0.06, 0.4);
            const auto deficit = [&](double at) {
                const Vec3 n = 7 * ring(1, angle),
                           added = tower_shadow(shadow, n, ring(r, angle + at), drag, turbulence);
                CHECK(added.cross(n).norm() < 1e-13);
                return -added.dot(n) / n.squaredNorm();
            };
            const double here = deficit(place_angle);
            CAPTURE(static_cast<int>(shadow), place_angle, r);
            CHECK(here == Approx(deficit(-place_angle)).margin(1e-13));
            CHECK(here >= 0);
            CHECK(here <= 0.5 + 1e-15);
            if (std::abs(place_angle) >= pi / 2) CHECK(here == 0);
            if (shadow == TowerShadow::powles && r * std::abs(std::sin(place_angle)) > std::sqrt(r)) CHECK(here == 0);
        }
    CHECK(tower_shadow(TowerShadow::none, blowing, {2, 0, 0}, 1, 0.1) == Vec3::Zero());
}

// Momentum: what a small deficit takes from the wind is the drag, rho V^2 R int D dy = rho/2 V^2 2 R C_d with y over R.
TEST_CASE("tower shadow: the wake carries the drag", "[analytic]") {
    const double drag = 0.4;
    for (const double x : {6.0, 12.0, 25.0}) {
        const auto across = [&](TowerShadow shadow, double turbulence) {
            constexpr int steps = 4000;
            double sum = 0;
            for (int i = -steps; i <= steps; ++i)
                sum -= tower_shadow(shadow, blowing, {x, 40.0 * i / steps, 0}, drag, turbulence).x() * 40 / steps / 8;
            return sum;
        };
        CHECK(across(TowerShadow::eames, 0.1) == Approx(drag).epsilon(1e-10));
        CHECK(across(TowerShadow::eames, 0.15) == Approx(drag).epsilon(1e-10));
        // With r = x exactly; in the wake, y^2 < r, they differ by 1/(2 x) of it at most.
        CHECK(across(TowerShadow::powles, 0) == Approx(drag).epsilon(1 / (2 * x)));
    }
}

TEST_CASE("tower shadow: continuous around the tower, with the flow as well", "[property]") {
    // The largest step halves when the steps do.
    const auto largest_step = [](TowerShadow shadow, double r, int steps) {
        double out = 0;
        const auto at = [&](int i) {
            const Vec3 place = ring(r, 2 * pi * i / steps);
            return Vec3(tower_influence(TowerInfluence::bak, blowing, place, 0.7) +
                        tower_shadow(shadow, blowing, place, 0.7, 0.12));
        };
        for (int i = 0; i < steps; ++i) out = std::max(out, (at(i + 1) - at(i)).norm());
        return out;
    };
    for (const TowerShadow shadow : shadows)
        for (const double r : {1.02, 1.5, 3.0, 10.0}) {
            CAPTURE(static_cast<int>(shadow), r);
            CHECK(largest_step(shadow, r, 7200) == Approx(largest_step(shadow, r, 3600) / 2).epsilon(0.02));
        }
}

TEST_CASE("tower shadow: derivatives", "[property]") {
    Random random(8);
    const double h = 1e-6;
    int in_it = 0;
    for (const TowerShadow shadow : shadows)
        for (int i = 0; i < 60; ++i) {
            const double angle = uniform(random, -pi, pi), drag = uniform(random, 0.1, 0.8),
                         turbulence = uniform(random, 0.1, 0.4);
            const Vec3 wind = uniform(random, 1, 20) * ring(1, angle),
                       place = ring(uniform(random, 1.05, 8), angle + (i == 0 ? 0 : uniform(random, -0.9, 0.9)));
            const auto at = [&](const Vec3& n, const Vec3& X, double C, double I) {
                return tower_shadow(shadow, n, X, C, I);
            };
            const TowerInfluenceSlopes slopes = tower_shadow_slopes(shadow, wind, place, drag, turbulence);
            CAPTURE(static_cast<int>(shadow), i, wind, place, drag, turbulence);
            const double rounding = 1e-8 * wind.norm();
            for (int k = 0; k < 2; ++k) {
                const Vec3 d = h * Vec3::Unit(k);
                const Vec3 by_wind = (at(wind + d, place, drag, turbulence) - at(wind - d, place, drag, turbulence)) /
                                     (2 * h),
                           by_place = (at(wind, place + d, drag, turbulence) - at(wind, place - d, drag, turbulence)) /
                                      (2 * h);
                CHECK((slopes.by_wind.col(k) - by_wind).norm() < rounding);
                CHECK((slopes.by_place.col(k) - by_place).norm() < rounding);
            }
            const Vec3 by_drag =
                           (at(wind, place, drag + h, turbulence) - at(wind, place, drag - h, turbulence)) / (2 * h),
                       by_turbulence =
                           (at(wind, place, drag, turbulence + h) - at(wind, place, drag, turbulence - h)) / (2 * h);
            CHECK((slopes.by_drag - by_drag).norm() < rounding);
            CHECK((slopes.by_turbulence - by_turbulence).norm() < rounding);
            const double deficit = at(wind, place, drag, turbulence).norm() / wind.norm();
            if (deficit > 1e-3 && deficit < 0.499) ++in_it;
        }
    CHECK(in_it > 30);
    for (const TowerShadow shadow : shadows) {
        CHECK(tower_shadow(shadow, Vec3::Zero(), {2, 0, 0}, 0.5, 0.1) == Vec3::Zero());
        CHECK(tower_shadow_slopes(shadow, Vec3::Zero(), {2, 0, 0}, 0.5, 0.1).by_wind.allFinite());
        // Just behind the middle a wake of Gauss is narrower than any number.
        const TowerInfluenceSlopes beside = tower_shadow_slopes(shadow, blowing, {1e-320, 2, 0}, 0.5, 0.1);
        CHECK(beside.by_place == Mat3::Zero());
    }
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
    const auto eames = [](std::vector<double> turbulence) {
        return [turbulence = std::move(turbulence)](AeroTower& t) {
            t.shadow = TowerShadow::eames;
            t.turbulence = turbulence;
        };
    };
    CHECK_NOTHROW(with(eames({0.1, 0.2, 0.3}))());
    check_refused(with(eames({})), {"air on the tower", "number of turbulence intensities = 0", "3"});
    check_refused(with(eames({0.1, 0, 0.1})), {"row 2", "turbulence intensity = 0", "more than 0, less than 1"});
    check_refused(with(eames({0.1, 0.1, 12})), {"row 3", "turbulence intensity = 12"});
    check_refused(with([](AeroTower& t) { t = {.shadow = TowerShadow::powles}; }),
                  {"number of rows = 0", "for the tower's influence"});
    check_refused(with([](AeroTower& t) { t.foot = std::numeric_limits<double>::infinity(); }), {"foot", "inf"});
    check_refused(with([](AeroTower& t) { t = {.influence = TowerInfluence::bak}; }),
                  {"number of rows = 0", "for the tower's influence"});
    check_refused(with([](AeroTower& t) { t = {.height = {1}, .diameter = {1}, .drag = {1}}; }), {"rows = 1"});
    check_refused([] { AeroNacelle{.area = {1, -2, 3}}.check(); }, {"air on the nacelle", "area [m^2] = -2"});
}

}  // namespace cardan::testing::tower_influence_tests
