// The way of a drive within limits of rate and acceleration: closed forms, limits, turning back.
#include "mbs/travel.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace cardan;
using namespace cardan::testing;

namespace {

// Central differences of fourth order within the phase that holds at t.
template <class Value>
double slope(double t, Value&& value) {
    constexpr double h = 1e-3;
    return (8 * (value(t + h) - value(t - h)) - (value(t + 2 * h) - value(t - 2 * h))) / (12 * h);
}

}  // namespace

TEST_CASE("travel: a long way takes way over rate and one and a half times the time to the rate, a short one less",
          "[analytic]") {
    const TravelLimits limits{0.2, 0.5};
    const Travel far(3, {1, 0, 0}, 2, limits);
    CHECK(far.arrival() == Approx(3 + 1 / 0.2 + 1.5 * 0.2 / 0.5).epsilon(1e-14));
    CHECK(far.at((3 + far.arrival()) / 2).position == Approx(1.5).epsilon(1e-14));  // symmetric
    CHECK(far.at((3 + far.arrival()) / 2).rate == Approx(0.2).epsilon(1e-14));
    // Without a phase at the full rate: up and down at 3/2 of the mean acceleration, way = rate * time / 2.
    const Travel near(0, {0, 0, 0}, -0.03, limits);
    CHECK(near.arrival() == Approx(2 * std::sqrt(1.5 * 0.03 / 0.5)).epsilon(1e-14));
    CHECK(near.at(near.arrival() / 2).rate == Approx(-2 * 0.03 / near.arrival()).epsilon(1e-14));
    CHECK(near.at(near.arrival() / 4).acceleration == Approx(-0.5).epsilon(1e-14));
    const Travel none(0, {0.7, 0, 0}, 0.7, limits);
    CHECK(none.arrival() == 0);
    CHECK(none.at(5).position == 0.7);
}

TEST_CASE("travel: from any state it comes to rest at the target, smoothly, within the limits", "[property]") {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> u(-1, 1);
    for (int i = 0; i < 200; ++i) {
        const TravelLimits limits{0.3 + 0.2 * u(random), 0.4 + 0.3 * u(random)};
        const double start = u(random), from = u(random), to = u(random);
        const double rate = (i % 4 == 0 ? 0.0 : 1.0) * limits.rate * u(random);
        const Travel travel(start, {from, rate, 0}, to, limits);
        CAPTURE(i, start, from, rate, to, limits.rate, limits.acceleration);
        const double length = travel.arrival() - start;
        CHECK(travel.at(start).position == Approx(from).margin(1e-12));
        CHECK(travel.at(start).rate == Approx(rate).margin(1e-12));
        CHECK(travel.at(start - 1).position == Approx(from - rate).margin(1e-12));
        CHECK(travel.at(travel.arrival() + 1).position == to);
        for (double t : travel.breaks()) {
            const Travel::State left = travel.at(t, t - 1e-9), right = travel.at(t, t + 1e-9);
            CHECK(left.position == Approx(right.position).margin(1e-12));
            CHECK(left.rate == Approx(right.rate).margin(1e-12));
            CHECK(left.acceleration == Approx(right.acceleration).margin(1e-6));
        }
        CHECK(std::ranges::is_sorted(travel.breaks()));
        for (int k = 0; k <= 100; ++k) {
            const double t = start + length * k / 100;
            const Travel::State now = travel.at(t);
            REQUIRE(std::abs(now.rate) <= limits.rate * (1 + 1e-12));
            REQUIRE(std::abs(now.acceleration) <= limits.acceleration * (1 + 1e-12));
            REQUIRE(now.rate == Approx(slope(t, [&](double s) { return travel.at(s, t).position; })).margin(1e-7));
            REQUIRE(now.acceleration == Approx(slope(t, [&](double s) { return travel.at(s, t).rate; })).margin(1e-7));
        }
    }
}

TEST_CASE("travel: a start that is faster than allowed slows down to what is allowed", "[property]") {
    const Travel travel(0, {0, 1, 0}, 5, {0.4, 0.5});
    CHECK(travel.at(0).rate == 1);
    CHECK(travel.at(2).rate == Approx(0.4).epsilon(1e-12));
    CHECK(travel.at(travel.arrival()).position == 5);
    // Too fast to stop in time: beyond the target and back.
    const Travel beyond(0, {0, 1, 0}, 0.1, {0.4, 0.5});
    double farthest = 0;
    for (double t = 0; t < beyond.arrival(); t += 0.01) farthest = std::max(farthest, beyond.at(t).position);
    CHECK(farthest > 1);
    CHECK(beyond.at(beyond.arrival()).position == 0.1);
}

TEST_CASE("travel: bad values are refused", "[property]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    check_refused([&] { Travel travel(nan); }, {"travel of a drive: position = nan", "finite"});
    check_refused([&] { Travel(nan, {}, 1, {1, 1}); }, {"time [s] = nan"});
    check_refused([&] { Travel(0, {nan, 0, 0}, 1, {1, 1}); }, {"position at the start = nan"});
    check_refused([&] { Travel(0, {0, nan, 0}, 1, {1, 1}); }, {"rate at the start = nan"});
    check_refused([&] { Travel(0, {}, nan, {1, 1}); }, {"target = nan"});
    check_refused([] { Travel(0, {}, 1, {0, 1}); }, {"largest rate = 0; allowed: finite and > 0"});
    check_refused([] { Travel(0, {}, 1, {1, -1}); }, {"largest acceleration = -1"});
}
