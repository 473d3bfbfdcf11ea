// Trajectory of a drive within limits of rate and acceleration: closed forms, limits, turning back.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/trajectory.hpp"
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

TEST_CASE("trajectory: a long one takes distance over rate and 1.5 times the time to that rate, a short one less",
          "[analytic]") {
    const TrajectoryLimits limits{0.2, 0.5};
    const Trajectory far(3, {1, 0, 0}, 2, limits);
    CHECK(far.arrival() == Approx(3 + 1 / 0.2 + 1.5 * 0.2 / 0.5).epsilon(1e-14));
    CHECK(far.at((3 + far.arrival()) / 2).position == Approx(1.5).epsilon(1e-14));  // symmetric
    CHECK(far.at((3 + far.arrival()) / 2).rate == Approx(0.2).epsilon(1e-14));
    CHECK(default_jerk(limits) == Approx(2.5).epsilon(1e-15));
    CHECK(far.at(3 + 0.2 / 0.5 * 0.75).acceleration == Approx(0.5).epsilon(1e-14));
    // Too short for the largest acceleration: four phases of jerk of equal length T, distance = 2 j T^3.
    const Trajectory near(0, {0, 0, 0}, -0.03, limits);
    const double T = std::cbrt(0.03 / (2 * 2.5));
    CHECK(near.arrival() == Approx(4 * T).epsilon(1e-12));
    CHECK(near.at(2 * T).rate == Approx(-2.5 * T * T).epsilon(1e-12));
    CHECK(near.at(T).acceleration == Approx(-2.5 * T).epsilon(1e-12));
    CHECK(near.at(3 * T).acceleration == Approx(2.5 * T).epsilon(1e-12));
    const Trajectory none(0, {0.7, 0, 0}, 0.7, limits);
    CHECK(none.arrival() == 0);
    CHECK(none.at(5).position == 0.7);
}

TEST_CASE("trajectory: from any state it comes to rest at the target, smoothly, within the limits", "[property]") {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> u(-1, 1);
    for (int i = 0; i < 200; ++i) {
        const TrajectoryLimits limits{0.3 + 0.2 * u(random), 0.4 + 0.3 * u(random)};
        const double start = u(random), from = u(random), to = u(random);
        const double rate = (i % 4 == 0 ? 0.0 : 1.0) * limits.rate * u(random);
        const double acceleration = (i % 3 == 0 ? 0.0 : 1.0) * limits.acceleration * u(random);
        const Trajectory trajectory(start, {from, rate, acceleration}, to, limits);
        CAPTURE(i, start, from, rate, acceleration, to, limits.rate, limits.acceleration);
        const double length = trajectory.arrival() - start;
        // The acceleration at the start may carry the rate beyond its limit.
        const double reached = rate + acceleration * std::abs(acceleration) / (2 * default_jerk(limits));
        const double fastest = std::max(limits.rate, std::abs(reached));
        CHECK(trajectory.at(start).position == Approx(from).margin(1e-12));
        CHECK(trajectory.at(start).rate == Approx(rate).margin(1e-12));
        CHECK(trajectory.at(start).acceleration == Approx(acceleration).margin(1e-12));
        CHECK(trajectory.at(start - 1).position == Approx(from - rate + acceleration / 2).margin(1e-12));
        CHECK(trajectory.at(trajectory.arrival() + 1).position == to);
        for (double t : trajectory.breaks()) {
            const Trajectory::State left = trajectory.at(t, t - 1e-9), right = trajectory.at(t, t + 1e-9);
            CHECK(left.position == Approx(right.position).margin(1e-12));
            CHECK(left.rate == Approx(right.rate).margin(1e-12));
            CHECK(left.acceleration == Approx(right.acceleration).margin(1e-9));
        }
        CHECK(std::ranges::is_sorted(trajectory.breaks()));
        for (int k = 0; k <= 100; ++k) {
            const double t = start + length * k / 100;
            const Trajectory::State now = trajectory.at(t);
            REQUIRE(std::abs(now.rate) <= fastest * (1 + 1e-12));
            REQUIRE(std::abs(now.acceleration) <= limits.acceleration * (1 + 1e-12));
            REQUIRE(now.rate == Approx(slope(t, [&](double s) { return trajectory.at(s, t).position; })).margin(1e-7));
            REQUIRE(now.acceleration ==
                    Approx(slope(t, [&](double s) { return trajectory.at(s, t).rate; })).margin(1e-7));
        }
    }
}

TEST_CASE("trajectory: restarted from any of its states it is the remainder of the first one", "[property]") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> u(-1, 1);
    for (int i = 0; i < 100; ++i) {
        const TrajectoryLimits limits{0.3 + 0.2 * u(random), 0.4 + 0.3 * u(random), i % 2 ? 0 : 2 + u(random)};
        const double to = u(random);
        const Trajectory whole(0, {u(random), 0.3 * u(random), 0.1 * u(random)}, to, limits);
        for (int k = 1; k < 40; ++k) {
            const double t = whole.arrival() * k / 40,
                         later = t + whole.arrival() * (40 - k) / 40 * (u(random) + 1) / 2;
            const Trajectory rest(t, whole.at(t), to, limits);
            CAPTURE(i, k);
            // Where it stops is known to the last digit only; a distance of 1e-16 takes (1e-16 / jerk)^(1/3) s.
            REQUIRE(rest.arrival() == Approx(whole.arrival()).margin(1e-4));
            REQUIRE(rest.at(later).position == Approx(whole.at(later).position).margin(1e-12));
            REQUIRE(rest.at(later).rate == Approx(whole.at(later).rate).margin(1e-8));
        }
    }
}

TEST_CASE("trajectory: no motion within the limits is faster", "[analytic]") {
    // Switching times of the fastest motion with limited jerk alone, from rate v and acceleration a (both away from
    // rest): found by Newton's method on the three conditions at the end, by hand of the formulas of constant jerk.
    const double j = 1.7, v = 0.4, a = -0.25, to = 2.1;
    Eigen::Vector3d T(1, 2, 1);
    for (int i = 0; i < 60; ++i) {
        const auto end = [&](const Eigen::Vector3d& times) {
            Eigen::Vector3d s(0, v, a);
            const double jerks[] = {j, -j, j};
            for (int k = 0; k < 3; ++k) {
                const double t = times(k), J = jerks[k];
                s = Eigen::Vector3d(s(0) + t * (s(1) + t * (s(2) / 2 + t * J / 6)), s(1) + t * (s(2) + t * J / 2),
                                    s(2) + t * J);
            }
            return Eigen::Vector3d(s - Eigen::Vector3d(to, 0, 0));
        };
        Eigen::Matrix3d D;
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d d = 1e-6 * Eigen::Vector3d::Unit(k);
            D.col(k) = (end(T + d) - end(T - d)) / 2e-6;
        }
        T -= D.partialPivLu().solve(end(T));
    }
    REQUIRE(T.minCoeff() > 0);
    const Trajectory trajectory(5, {0, v, a}, to, {100, 100, j});
    CHECK(trajectory.arrival() - 5 == Approx(T.sum()).epsilon(1e-9));
    CHECK(trajectory.at(5 + T(0)).acceleration == Approx(a + j * T(0)).epsilon(1e-9));
}

TEST_CASE("trajectory: straight at a constant rate", "[analytic]") {
    const Trajectory trajectory = Trajectory::straight(2, 1, -1, 4);
    CHECK(trajectory.at(3).position == Approx(0.5).epsilon(1e-15));
    CHECK(trajectory.at(3).rate == -0.5);
    CHECK(trajectory.arrival() == 6);
    CHECK(trajectory.at(6).position == -1);
    CHECK(trajectory.at(6).rate == 0);
    check_refused([] { (void)Trajectory::straight(0, 0, 1, 0); }, {"duration [s] = 0; allowed: finite and > 0"});
}

TEST_CASE("trajectory: a start that is faster than allowed slows down to what is allowed", "[property]") {
    const Trajectory trajectory(0, {0, 1, 0}, 5, {0.4, 0.5});
    CHECK(trajectory.at(0).rate == 1);
    CHECK(trajectory.at(2).rate == Approx(0.4).epsilon(1e-12));
    CHECK(trajectory.at(trajectory.arrival()).position == 5);
    // Too fast to stop in time: beyond the target and back.
    const Trajectory beyond(0, {0, 1, 0}, 0.1, {0.4, 0.5});
    double farthest = 0;
    for (double t = 0; t < beyond.arrival(); t += 0.01) farthest = std::max(farthest, beyond.at(t).position);
    CHECK(farthest > 1);
    CHECK(beyond.at(beyond.arrival()).position == 0.1);
}

TEST_CASE("trajectory: bad values are refused", "[property]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    check_refused([&] { Trajectory trajectory(nan); }, {"trajectory of a drive: position = nan", "finite"});
    check_refused([&] { Trajectory(nan, {}, 1, {1, 1}); }, {"time [s] = nan"});
    check_refused([&] { Trajectory(0, {nan, 0, 0}, 1, {1, 1}); }, {"position at the start = nan"});
    check_refused([&] { Trajectory(0, {0, nan, 0}, 1, {1, 1}); }, {"rate at the start = nan"});
    check_refused([&] { Trajectory(0, {}, nan, {1, 1}); }, {"target = nan"});
    check_refused([] { Trajectory(0, {}, 1, {0, 1}); }, {"largest rate = 0; allowed: finite and > 0"});
    check_refused([] { Trajectory(0, {}, 1, {1, -1}); }, {"largest acceleration = -1"});
    check_refused([] { Trajectory(0, {}, 1, {1, 1, -1}); }, {"largest jerk = -1"});
    check_refused([&] { Trajectory(0, {0, 0, nan}, 1, {1, 1}); }, {"acceleration at the start = nan"});
    check_refused([] { Trajectory(0, {}, 1e300, {1e-300, 1}); }, {"trajectory of a drive: ", "allowed: finite"});
}
