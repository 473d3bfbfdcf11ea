// Gusts as changes of a wind: their shapes against closed forms, at the hub and off it, and what is refused.
#include "elements/wind/gust.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

#include <array>
#include <cmath>
#include <random>

namespace cardan::testing::gust_tests {

namespace {

constexpr double start = 20;

// Of all kinds, with start and hub height the same.
const std::array all_gusts{Gust{.kind = GustKind::eog, .start = start, .duration = 10.5, .speed = 5},
                           Gust{.kind = GustKind::edc, .start = start, .duration = 6, .angle = 0.5},
                           Gust{.kind = GustKind::ecd, .start = start, .duration = 10, .speed = 15, .angle = -1.1},
                           Gust{.kind = GustKind::ews_vertical, .start = start, .duration = 12, .gradient = 0.09},
                           Gust{.kind = GustKind::ews_horizontal, .start = start, .duration = 12, .gradient = -0.09}};

// About a height that is not the hub's, with everything that a steady wind may have.
const SteadyWind sheared{.speed = 9,
                         .reference_height = 60,
                         .shear = Shear::power,
                         .exponent = 0.2,
                         .gradient = 0.001,
                         .direction = 0.3,
                         .veer = 0.001,
                         .upflow = 0.1,
                         .lateral = -0.002,
                         .gust = 0.5,
                         .vertical = 0.2,
                         .ground = -15};

// What changes of the wind, in the order of SteadyWind.
Eigen::Vector4d change(const Gust& gust, double time) {
    const SteadyWind to = gust.applied(sheared, time);
    return {to.gradient - sheared.gradient, to.direction - sheared.direction, to.lateral - sheared.lateral,
            to.gust - sheared.gust};
}

Gust mirrored(Gust gust) {
    gust.angle = -gust.angle;
    gust.gradient = -gust.gradient;
    return gust;
}

}  // namespace

TEST_CASE("gust: EOG has its peak, its dips and its mean at closed forms", "[analytic]") {
    const Gust gust = all_gusts[0];
    const auto at = [&](double s) { return gust.applied({.speed = 10}, start + 10.5 * s).gust; };
    CHECK(at(0.5) == Approx(0.74 * 5));
    for (const double s : {1 / 3., 2 / 3., 1.0}) CHECK(std::abs(at(s)) < 1e-14);
    CHECK(at(1 / 6.) == Approx(-0.37 * 5 / 2));
    // -0.37 V times the integral of sin(3 pi s) (1 - cos 2 pi s) over s from 0 to 1 is 0.37 V 8/(15 pi). By midpoints:
    // the difference of the slopes at both ends, with which their error begins, is zero.
    constexpr int n = 2000;
    double sum = 0, lowest = 0;
    for (int i = 0; i < n; ++i) {
        const double s = (i + 0.5) / n;
        sum += at(s) / n;
        lowest = std::min(lowest, at(s));
        CHECK(at(s) == Approx(at(1 - s)).margin(1e-12));
    }
    CHECK(std::abs(sum - 0.37 * 5 * 8 / (15 * pi)) < 1e-9);
    // The dips are where 3 cos(3 pi s) (1 - cos 2 pi s) + 2 sin(3 pi s) sin 2 pi s = 0; divided by 2 sin^2 pi s and
    // with c = cos^2 pi s that is 3 (4c - 3) + 2 (4c - 1) = 0 over cos pi s: c = 11/20.
    const double c = 11 / 20., dip = std::acos(std::sqrt(c)) / pi;
    CHECK(at(dip) <= lowest);
    CHECK(std::abs(at(dip + 1e-4) - at(dip - 1e-4)) / 2e-4 < 1e-5);  // third derivative, below 5200, times 1e-8/6
    CHECK(at(dip) == Approx(-0.37 * 5 * (4 * c - 1) * std::sqrt(1 - c) * 2 * (1 - c)));
}

TEST_CASE("gust: direction changes and shears are raised cosines", "[analytic]") {
    for (const double s : {0.1, 0.25, 0.5, 0.8, 1.0}) {
        const double once = std::pow(std::sin(pi * s / 2), 2), twice = std::pow(std::sin(pi * s), 2);
        const auto at = [&](std::size_t i) { return change(all_gusts[i], start + s * all_gusts[i].duration); };
        CAPTURE(s);
        CHECK((at(1) - Eigen::Vector4d(0, 0.5 * once, 0, 0)).norm() < 1e-14);
        CHECK((at(2) - Eigen::Vector4d(0, -1.1 * once, 0, 15 * once)).norm() < 1e-13);
        CHECK((at(3) - Eigen::Vector4d(0.01 * twice, 0, 0, 0.09 * (60 - 90) * twice)).norm() < 1e-14);
        CHECK((at(4) - Eigen::Vector4d(0, 0, -0.01 * twice, 0)).norm() < 1e-14);
    }
}

TEST_CASE("gust: nothing before it, after it what stays, in between with continuous slopes", "[analytic]") {
    for (const Gust& gust : all_gusts) {
        CAPTURE(name_of(gust.kind));
        CHECK(gust.breaks() == std::vector<double>{start, start + gust.duration});
        for (const double time : {-1e3, 0.0, start}) CHECK(change(gust, time).norm() == 0);
        const bool stays = gust.kind == GustKind::edc || gust.kind == GustKind::ecd;
        const Eigen::Vector4d last = change(gust, gust.end());
        CHECK((last - (stays ? Eigen::Vector4d(0, gust.angle, 0, gust.speed) : Eigen::Vector4d::Zero())).norm() <
              1e-14);
        for (const double time : {gust.end() + 1e-9, 1e6}) CHECK((change(gust, time) - last).norm() < 1e-14);
        // From both ends the change grows with the square of the time, that of EOG with its third power.
        const double h = 1e-3 * gust.duration, order = gust.kind == GustKind::eog ? 3 : 2;
        const auto begun = [&](double t) { return change(gust, start + t).norm(); };
        const auto left = [&](double t) { return (change(gust, gust.end() - t) - last).norm(); };
        CHECK(std::abs(observed_order(begun(h), begun(h / 2)) - order) < 1e-3);
        CHECK(std::abs(observed_order(left(h), left(h / 2)) - order) < 1e-3);
    }
    CHECK(Gust{}.breaks().empty());
    CHECK(Gust{}.applied(sheared, 5).at({1, 2, 3}) == sheared.at({1, 2, 3}));
}

TEST_CASE("gust: shears change nothing at the hub, whatever height the wind refers to", "[analytic]") {
    const SteadyWind flat{.speed = 9, .reference_height = 60, .direction = 0.3, .ground = -15};
    const Vec3 along(std::cos(0.3), std::sin(0.3), 0), left(-std::sin(0.3), std::cos(0.3), 0);
    const Vec3 hub = 7 * along + Vec3(0, 0, 90 - 15);
    for (const double time : {21.0, 26.0, 31.0}) {
        const double passing = std::pow(std::sin(pi * (time - start) / 12), 2);
        for (const auto& [gust, off] : {std::pair(all_gusts[3], Vec3(0, 0, 1)), {all_gusts[4], left}}) {
            const SteadyWind at = gust.applied(flat, time);
            CHECK((at.at(hub) - flat.at(hub)).norm() < 1e-13);
            for (const double distance : {-40.0, 63.0})
                CHECK((at.at(hub + distance * off) - (9 + gust.gradient * distance * passing) * along).norm() < 1e-13);
            CHECK((at.gradient_at(hub) - gust.gradient * passing * along * off.transpose()).norm() < 1e-15);
        }
    }
}

TEST_CASE("gust: the other sign is the mirror image", "[property]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    const SteadyWind straight{.speed = 11, .reference_height = 80, .shear = Shear::power, .exponent = 0.2};
    const Vec3 reflection(1, -1, 1);
    for (int i = 0; i < 50; ++i) {
        const Vec3 place(30 * any(random), 60 * any(random), 90 + 60 * any(random));
        const double time = 26 + 8 * any(random);
        for (const Gust& gust : all_gusts) {
            const Vec3 here = gust.applied(straight, time).at(place);
            if (gust.kind == GustKind::ews_vertical) {
                // Of a wind that is the same at all heights: upside down about the hub.
                const SteadyWind flat{.speed = 11, .reference_height = 80};
                const Vec3 below(place.x(), place.y(), 180 - place.z());
                CHECK((gust.applied(flat, time).at(place) - mirrored(gust).applied(flat, time).at(below)).norm() <
                      1e-13);
                CHECK((here + mirrored(gust).applied(straight, time).at(place) - 2 * straight.at(place)).norm() <
                      1e-13);
            } else {
                const Vec3 there = mirrored(gust).applied(straight, time).at(place.cwiseProduct(reflection));
                CHECK((here - there.cwiseProduct(reflection)).norm() < 1e-13);
            }
        }
    }
}

TEST_CASE("gust: a positive angle turns the wind to the left, a positive gradient is more wind above and on the left",
          "[property]") {
    const SteadyWind wind{.speed = 10};
    const auto applied = [&](GustKind kind, Gust gust, const Vec3& place) {
        gust.kind = kind;
        gust.duration = 10;
        return gust.applied(wind, 5).at(place);
    };
    const Vec3 hub(0, 0, 90), above(0, 0, 100), left(0, 10, 90);
    CHECK(applied(GustKind::edc, {.angle = 0.2}, hub).isApprox(10 * Vec3(std::cos(0.1), std::sin(0.1), 0)));
    CHECK(applied(GustKind::ews_vertical, {.gradient = 0.1}, above).isApprox(Vec3(11, 0, 0)));
    CHECK(applied(GustKind::ews_horizontal, {.gradient = 0.1}, left).isApprox(Vec3(11, 0, 0)));
}

TEST_CASE("gust: applied without allocating", "[property]") {
    double sum = 0;
    CHECK(allocations([&] {
              for (const Gust& gust : all_gusts) sum += gust.applied(sheared, 25).direction;
          }) == 0);
    CHECK(sum != 0);
}

TEST_CASE("gust: bad input is refused by name", "[property]") {
    for (const Gust& gust : all_gusts) CHECK_NOTHROW(gust.check());
    CHECK_NOTHROW(Gust{}.check());
    const auto refused = [](const Gust& good, auto change, std::initializer_list<std::string> parts) {
        Gust bad = good;
        change(bad);
        check_refused([&] { bad.check(); }, parts);
    };
    const auto& [eog, edc, ecd, vertical, horizontal] = all_gusts;
    refused(eog, [](Gust& g) { g.start = not_a_number; }, {"gust (EOG)", "start [s] = nan"});
    refused(eog, [](Gust& g) { g.start = infinite; }, {"start [s] = inf"});
    refused(edc, [](Gust& g) { g.duration = 0; }, {"gust (EDC)", "duration [s] = 0", "0.001 ... "});
    refused(edc, [](Gust& g) { g.duration = -6; }, {"duration [s] = -6"});
    refused(ecd, [](Gust& g) { g.speed = -15; }, {"gust (ECD)", "speed [m/s] = -15", "0 ... 1000"});
    refused(ecd, [](Gust& g) { g.speed = not_a_number; }, {"speed [m/s] = nan"});
    refused(edc, [](Gust& g) { g.angle = 3.2; }, {"angle [rad] = 3.2", "3.14"});
    refused(edc, [](Gust& g) { g.angle = not_a_number; }, {"angle [rad] = nan"});
    refused(vertical, [](Gust& g) { g.gradient = -1e4; }, {"gust (vertical EWS)", "gradient [m/s per m] = -10000"});
    refused(horizontal, [](Gust& g) { g.hub_height = 0; }, {"gust (horizontal EWS)", "hub height [m] = 0"});
    refused(eog, [](Gust& g) { g.angle = 0.1; }, {"gust (EOG)", "angle [rad] = 0.1", "has none"});
    refused(edc, [](Gust& g) { g.speed = 1; }, {"speed [m/s] = 1", "has none"});
    refused(ecd, [](Gust& g) { g.gradient = 1; }, {"gradient [m/s per m] = 1", "has none"});
    for (const Gust& shear : {vertical, horizontal}) {
        check_refused([&] { static_cast<void>(shear.applied({.speed = 0}, 25)); },
                      {"speed of the wind [m/s] = 0", "factor"});
        CHECK(shear.applied({.speed = 0}, 5).gust == 0);
        CHECK(shear.applied({.speed = 0}, 50).gust == 0);
    }
    CHECK(eog.applied({.speed = 0}, 25).gust != 0);
}

}  // namespace cardan::testing::gust_tests
